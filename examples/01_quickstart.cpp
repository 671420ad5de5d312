// A curvature-continuous blend between two coaxial pipes, proved, and exported as STEP.
//   ./build/release/examples/01_quickstart  ->  reducer.step
#include <iostream>

#include "app/pipeline/write_outputs.hpp"

using namespace blendwright;

int main() {
  JobSpec job;
  job.name = "reducer";
  job.primaries = {
      {"thin", PrimarySpec{.kind = "cylinder", .numbers = {{"radius", 1.0}}, .u = Interval{-2.0, 0.0}}},
      {"wide", PrimarySpec{.kind = "cylinder", .numbers = {{"radius", 2.0}}, .u = Interval{3.0, 5.0}}}};
  BlendEntry blend{.name = "reducer"};
  blend.sides[0] = {
      .primary = "thin", .trimline = TrimlineSpec{.value = 0.0}, .side = {.continuity = Continuity::G2}};
  blend.sides[1] = {
      .primary = "wide", .trimline = TrimlineSpec{.value = 3.0}, .side = {.continuity = Continuity::G2}};
  job.blends = {blend};
  job.output.formats = {OutputFormat::step};

  JobResult result = run_job(job);
  const JobOutputs outputs = write_outputs(result, {.folder = ".", .overwrite = true});
  for (const SeamReport& seam : result.blends[0].stages.back().seams)  // measured on the STEP file read back
    std::cout << seam.name << ": gap " << seam.gap.worst << " mm, angle "
              << Radians(seam.angle.worst).degrees() << " deg, curvature jump " << seam.curvature.worst
              << " 1/mm\n";
  return verified(result, &outputs) ? 0 : 1;
}
