// Question: how many steps per second do 1,000 moving bodies make?
//
// Bodies about as large as balls of radius 1 move by a twentieth and turn by a twentieth radian per step in a
// box that has them in contact so often: `dilute` about 10 contacts at a time, one body in a hundred;
// `dense` about 5,000, one pair in a hundred of all 499,500. Counters per step: contacts, candidates (pairs
// whose boxes meet), boxes of the searches, undecided pairs; steps per second of wall time on all cores, and
// placing alone.
#include <benchmark/benchmark.h>

#include "tests/bench/clocks.hpp"
#include "tests/bench/relation_models.hpp"

namespace {

using namespace blendwright;

constexpr std::size_t count = 1000;

std::vector<ScalarField> bodies(const std::string& kind) {
  std::vector<ScalarField> all;
  bench::Numbers numbers{11};
  for (std::size_t i = 0; i < count; ++i) {
    if (kind == "freeforms") {
      all.push_back(bench::freeform(20, i + 1));
      continue;
    }
    const bench::Shape shape = kind == "spheres"      ? bench::Shape::sphere
                               : kind == "ellipsoids" ? bench::Shape::ellipsoid
                                                      : bench::Shape::box;
    all.push_back(bench::planted_pair(numbers, shape, 1.0).first.field());
  }
  return all;
}

void MovingBodiesSteps(benchmark::State& state, const std::string& kind, double half_box) {
  MovingBodies moving(bodies(kind), {});
  bench::Crowd crowd(count, half_box, 5);
  for (int i = 0; i < 3; ++i) {
    (void)moving.at(crowd.placements());
    crowd.step(0.05);
  }
  double contacts = 0.0, undecided = 0.0, candidates = 0.0, boxes = 0.0;
  bench::Cost cost;
  for (auto _ : state) {
    std::vector<BodyPair> pairs;
    cost += bench::cost_of([&] { pairs = moving.at(crowd.placements(), true); });
    for (const BodyPair& p : pairs) {
      candidates += 1.0;
      boxes += static_cast<double>(p.collision.boxes);
      contacts += p.collision.contact == Contact::contact ? 1.0 : 0.0;
      undecided += p.collision.contact == Contact::undecided ? 1.0 : 0.0;
    }
    crowd.step(0.05);
  }
  const auto steps = static_cast<double>(state.iterations());
  state.counters["steps_per_second"] = steps / cost.wall;
  state.counters["cpu_ms"] = 1e3 * cost.cpu / steps;
  state.counters["contacts"] = contacts / steps;
  state.counters["undecided"] = undecided / steps;
  state.counters["candidates"] = candidates / steps;
  state.counters["boxes"] = boxes / steps;
}
constexpr double dilute = 60.0;  // half of the box
#define MOVING(kind, dense, dense_steps)                             \
  BENCHMARK_CAPTURE(MovingBodiesSteps, kind##_dilute, #kind, dilute) \
      ->Iterations(100)                                              \
      ->Unit(benchmark::kMillisecond);                               \
  BENCHMARK_CAPTURE(MovingBodiesSteps, kind##_dense, #kind, dense)   \
      ->Iterations(dense_steps)                                      \
      ->Unit(benchmark::kMillisecond)
MOVING(spheres, 7.5, 50);
MOVING(ellipsoids, 7.2, 50);
MOVING(boxes, 9.6, 50);
MOVING(freeforms, 7.0, 2);

/// Question: what does it cost to place a body? Nanoseconds per body.
void PlacingABody(benchmark::State& state, const std::string& kind) {
  const std::vector<ScalarField> all = bodies(kind);
  bench::Numbers numbers{1};
  const RigidMotion motion{numbers.turn(), numbers.vector(10.0)};
  for (auto _ : state)
    for (const ScalarField& body : all) benchmark::DoNotOptimize(placed(body, motion));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}
BENCHMARK_CAPTURE(PlacingABody, spheres, "spheres")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(PlacingABody, freeforms, "freeforms")->Unit(benchmark::kMicrosecond);

}  // namespace
