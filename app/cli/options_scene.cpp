#include "app/cli/arguments.hpp"
#include "app/cli/options.hpp"

namespace blendwright {
namespace {

/// What `mesh` and `offset` share.
void add_meshing(CLI::App* sub, MeshCommand& command) {
  sub->add_option("SCENE", command.scene, "scene file; - reads standard input")->required();
  sub->add_option("-o,--output", command.outputs,
                  "file to write, .vtp, .stl, .obj, .ply or .png; may be given again")
      ->allow_extra_args(false);
  sub->add_option("--solid", command.solid, "node that is meant instead of the scene's solid");
  CLI::Option* cell = sub->add_option("--cell", command.cell, "edge length of a cell, model units");
  cell->check(positive());
  sub->add_option("--cells", command.cells, "cells along the longest side instead of --cell")
      ->capture_default_str()
      ->check(CLI::Range(1, 1 << 20))
      ->excludes(cell);
  sub->add_option("--box", command.box, "box to mesh, x0,y0,z0,x1,y1,z1; default: around the solid")
      ->check(readable(box_argument, "BOX"));
  sub->add_option("--at-box", command.at_box, "where the box cuts the solid: cap closes it, open does not")
      ->capture_default_str()
      ->check(CLI::IsMember({"cap", "open"}));
  sub->add_option("--max-memory", command.max_memory, "refuse what needs more, in bytes, or with K, M or G")
      ->capture_default_str()
      ->check(readable(memory_argument, "SIZE"));
  sub->add_option("--colour,--color", command.colour,
                  "column that colours a .png; \"list columns\" names them");
  sub->add_flag("--force", command.force, "replace files that exist");
  CLI::Option* json = sub->add_flag("--json", command.json, "print JSON instead of the table");
  sub->add_flag("--times", command.times, "time of each stage in the JSON")->needs(json);
  sub->add_flag("--quiet", command.quiet, "no table, no warnings, no progress");
  add_threads(sub, command.threads);
}

}  // namespace

void add_mesh(CLI::App& app, Program& program) {
  const auto command = std::make_shared<MeshCommand>();
  command->called = program.called;
  CLI::App* sub = verb(app, "mesh");
  add_meshing(sub, *command);
  add_report(sub, command->report);
  sub->callback([command, &program] { program.code = mesh(*command, program.console); });
}

void add_eval(CLI::App& app, Program& program) {
  const auto command = std::make_shared<EvalCommand>();
  CLI::App* sub = verb(app, "eval");
  sub->add_option("SCENE", command->scene, "scene file; - reads standard input")->required();
  sub->add_option("--points", command->points,
                  "points, as .vtp or as lines of x, y, z; - reads standard input")
      ->required();
  sub->add_option("--solid", command->solid, "node to evaluate instead of the scene's solid");
  CLI::Option* output = sub->add_option("-o,--output", command->output, "file to write, .csv or .vtp");
  sub->add_flag("--force", command->force, "replace a file that exists");
  sub->add_flag("--json", command->json, "print JSON instead of lines")->excludes(output);
  sub->add_flag("--quiet", command->quiet, "no summary, no warnings, no progress");
  add_threads(sub, command->threads);
  sub->callback([command, &program] { program.code = eval(*command, program.console); });
}

void add_offset(CLI::App& app, Program& program) {
  const auto command = std::make_shared<OffsetCommand>();
  CLI::App* sub = verb(app, "offset");
  CLI::Option* distance = sub->add_option("--distance", command->distance,
                                          "offset by this length, model units; > 0 grows the solid");
  CLI::Option* shell = sub->add_option(
      "--shell", command->shell, "keep a wall along the surface: how far it reaches inward and outward");
  CLI::Option* round =
      sub->add_option("--round", command->round, "round convex edges with this radius (opening)");
  CLI::Option* fillet =
      sub->add_option("--fillet", command->fillet, "fillet concave edges with this radius (closing)");
  distance->check(finite())->excludes(shell)->excludes(round)->excludes(fillet);
  shell->check(readable(shell_argument, "INNER,OUTER"))->excludes(round)->excludes(fillet);
  round->check(positive())->excludes(fillet);
  fillet->check(positive());
  sub->add_option("--kind", command->kind,
                  "of --distance: ball has a constant radius, normal moves along the field's gradient, iso "
                  "adds to the field (a value, no length)")
      ->capture_default_str()
      ->check(CLI::IsMember({"ball", "normal", "iso"}))
      ->needs(distance);
  sub->add_option("--tolerance", command->tolerance,
                  "of balls where there is no closed form: how well values are enclosed")
      ->check(positive());
  add_meshing(sub, command->mesh);
  sub->footer(
      "\nThe offset is measured at points of the original surface, moved along their normals: how far the\n"
      "offset surface is from them (> 0: too large), with the place of the worst. Exit code 4: nothing is "
      "left.\n"
      "\nExamples:\n"
      "  blendwright offset scene.json --distance -2 -o smaller.vtp\n"
      "  blendwright offset scene.json --shell 1,0 -o skin.stl --cells 256\n"
      "  blendwright offset scene.json --round 0.5 --json");
  sub->callback([command, &program] { program.code = offset(*command, program.console); });
}

}  // namespace blendwright
