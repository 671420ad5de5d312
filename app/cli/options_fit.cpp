#include "app/cli/options.hpp"

namespace blendwright {

void add_fit(CLI::App& app, Program& program) {
  const auto command = std::make_shared<FitCommand>();
  command->called = program.called;
  CLI::App* sub = verb(app, "fit");
  sub->add_option("JOB", command->job, "job or scene file; - reads standard input")->required();
  sub->add_option("-o,--out,--output", command->output,
                  "the fitted job or scene, .json; - writes it to standard output");
  sub->add_option("--objective", command->objectives,
                  "instead of the job's objectives: thin_plate, rolling_ball=2, pass_through=1,0,2, "
                  "clearance=0.5,part.stl, ... (see list objectives); may be given again");
  optional_number(sub, "--starts", command->starts, "starts, to see whether there is one optimum",
                  CLI::Range(1, 1000));
  sub->add_option("--plot", command->plot, "also plot the convergence, .png or .svg");
  CLI::Option* points = sub->add_option(
      "--points", command->points, "of a scene: points of its surface, .vtp, .stl, .obj, .ply or lines of x, y, z");
  sub->add_option("--unknown", command->unknowns,
                  "of a scene: a number that may change and its bounds, form/a=1,10, or body/turn; may be given again; "
                  "without it, all that can")
      ->needs(points);
  sub->add_option("--robust-scale", command->robust_scale,
                  "of a scene: points farther off than this pull less and less, model units")
      ->needs(points)
      ->check(positive());
  sub->add_flag("--from-points", command->from_points,
                "of a scene: start from the points' box and axes, not from the scene's numbers")
      ->needs(points);
  add_report(sub, command->report);
  sub->add_flag("--force", command->force, "replace files that exist");
  add_json(sub, command->json, command->times);
  sub->add_flag("--quiet", command->quiet, "no table, no warnings, no progress");
  add_threads(sub, command->threads);
  sub->callback([command, &program] { program.code = fit(*command, program.console); });
}

}  // namespace blendwright
