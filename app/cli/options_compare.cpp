#include "app/cli/options.hpp"

namespace blendwright {

void add_compare(CLI::App& app, Program& program) {
  const auto command = std::make_shared<CompareCommand>();
  CLI::App* sub = verb(app, "compare");
  constexpr const char* what =
      "job, scene, .step, .vtp, .stl, .obj, .ply or a folder that blend wrote; part.step#name means that "
      "face, blend or node alone";
  sub->add_option("FIRST", command->first, what)->required();
  sub->add_option("SECOND", command->second, what)->required();
  sub->add_option("-o,--output", command->output,
                  "file for the first result with its deviation as a column, .vtp");
  optional_number(sub, "--limit", command->limit,
                  "exit with 1 when any point of either is further from the other, model units", positive());
  sub->add_flag("--force", command->force, "replace a file that exists");
  sub->add_flag("--json", command->json, "print JSON instead of the table");
  sub->add_flag("--quiet", command->quiet, "no table, no notes, no progress");
  add_threads(sub, command->threads);
  sub->footer(
      "\nThe Hausdorff distance, both ways, with its place. Between meshes distances are exact and the "
      "largest\n"
      "is proven; on surfaces the largest sample is led on to a maximum. Of a job its blends are compared, "
      "of\n"
      "a STEP file its faces; pieces of the same name with each other. Signs: > 0 on the side that the\n"
      "normals of the other result point to.\n"
      "\nExamples:\n"
      "  blendwright compare joint.json out/joint.step --limit 1e-6\n"
      "  blendwright compare old.stl new.stl -o deviation.vtp\n"
      "  blendwright compare out/joint.step#fillet scan.ply --json");
  sub->callback([command, &program] { program.code = compare(*command, program.console); });
}

}  // namespace blendwright
