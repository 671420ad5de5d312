// Question: how often a second can the viewer follow a hand: the blend built anew, 200 x 200 points with exact
// normals and error colours? Drawing is not part of it (blendwright view --script FILE --times tells it).
#include <benchmark/benchmark.h>

#include <fstream>
#include <iterator>

#include "app/json/job_reader.hpp"
#include "app/view/session/blend_session.hpp"

namespace blendwright {
namespace {

BlendSession opened() {
  const std::string file = BLENDWRIGHT_SOURCE_DIR "/examples/specs/varying-magnitude.json";
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return {text, read_job(text, file)};
}

std::size_t control(const BlendSession& session, const std::string& label) {
  const auto all = session.controls();
  std::size_t i = 0;
  while (i < all.size() && all[i].label != label) ++i;
  return i;
}

void slider(benchmark::State& state, const char* label) {
  BlendSession session = opened();
  const std::size_t index = control(session, label);
  double value = 1.0;
  for (auto _ : state)
    if (!session.set(index, value = value < 2.0 ? value + 0.001 : 1.0).done) state.SkipWithError("not built");
  state.counters["reshapes/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
void Reshape_tension(benchmark::State& state) { slider(state, "tension"); }
void Reshape_magnitude(benchmark::State& state) { slider(state, "magnitude from"); }
BENCHMARK(Reshape_tension)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(Reshape_magnitude)->UseRealTime()->Unit(benchmark::kMillisecond);

void Reshape_trimline(benchmark::State& state) {
  BlendSession session = opened();
  SessionHandle handle = session.handles().front();
  handle.reach = SessionHandle::Reach::here;
  const Vec3 along = Vec3(0.0, 0.0, -1.0);  // the pipe's axis, into the pipe
  double by = 0.0;
  const Vec3 start = handle.position;
  for (auto _ : state)
    if (!session.drag(handle, start + (by = by < 0.3 ? by + 0.001 : 0.001) * along).done)
      state.SkipWithError("not built");
  state.counters["reshapes/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(Reshape_trimline)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace blendwright
