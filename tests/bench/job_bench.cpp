// Question: how long is a whole job in memory, from primaries to a verified, fitted blend?
#include <benchmark/benchmark.h>

#include "app/json/job_reader.hpp"
#include "app/pipeline/run_job.hpp"

namespace {

using namespace blendwright;

void JobInMemory(benchmark::State& state, const char* name) {
  const JobSpec job = read_job_file(std::filesystem::path(BLENDWRIGHT_SOURCE_DIR) / "examples/specs" / name);
  JobResult last;
  for (auto _ : state) last = run_job(job);
  for (const StageTime& t : last.times) state.counters[t.stage + "_ms"] = 1e3 * t.seconds;
  double gap = 0.0;
  for (const SeamReport& seam : last.blends[0].stages.back().seams) gap = std::max(gap, seam.gap.worst);
  state.counters["gap_mm"] = gap;
}
BENCHMARK_CAPTURE(JobInMemory, coaxial_cylinders, "coaxial-cylinders.json")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(JobInMemory, branch_to_main, "branch-to-main.json")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(JobInMemory, eq14, "fig7-eq14.json")->Unit(benchmark::kMillisecond);

}  // namespace
