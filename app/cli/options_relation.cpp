#include "app/cli/arguments.hpp"
#include "app/cli/options.hpp"

namespace blendwright {
namespace {

void add_search(CLI::App* sub, SearchCommand& command) {
  sub->add_option("--tolerance", command.tolerance, "boxes of this size stay undecided, model units")
      ->capture_default_str()
      ->check(positive());
  sub->add_option("--max-boxes", command.max_boxes, "work limit; what is left then is undecided")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 40));
  sub->add_option("--domain", command.domain,
                  "where to look, x0,y0,z0,x1,y1,z1; default: where the bounds of the solids allow points")
      ->check(readable(box_argument, "BOX"));
}

}  // namespace

void add_relate(CLI::App& app, Program& program) {
  const auto command = std::make_shared<RelateCommand>();
  CLI::App* sub = verb(app, "relate");
  sub->add_option("SCENES", command->scenes,
                  "one or two scene files; part.json#node means another node than the scene's solid")
      ->required();
  add_search(sub, command->search);
  CLI::Option* points =
      sub->add_option("--points", command->points,
                      "say where these points lie instead: .vtp or lines of x, y, z; - reads standard input");
  sub->add_option("--mode", command->mode,
                  "a point is on the surface when: value, |phi| <= tolerance; length, the same over |grad "
                  "phi|; guaranteed, phi may be 0 within the tolerance around it")
      ->capture_default_str()
      ->check(CLI::IsMember({"value", "length", "guaranteed"}))
      ->needs(points);
  sub->add_flag("--confirm", command->confirm, "on the surface only where the outside is near")
      ->needs(points);
  CLI::Option* output =
      sub->add_option("-o,--output", command->output, "file for the points, .csv")->needs(points);
  sub->add_flag("--convert-units", command->convert_units, "scale the second scene to the unit of the first");
  sub->add_flag("--force", command->force, "replace a file that exists");
  sub->add_flag("--json", command->json, "print JSON instead of the table")
      ->excludes(output)
      ->excludes(points);
  sub->add_flag("--quiet", command->quiet, "no table, no warnings, no progress");
  add_threads(sub, command->threads);
  sub->footer(
      "\nEvery statement comes with its proof: proven, refuted by a witness point, or undecided.\n"
      "Exit code 0: decided; 1: undecided. Points print x,y,z,s2,s3,phi,distance: s2 1 in the closed solid,\n"
      "s3 0 outside, 1 on the surface, 2 inside; phi > 0 inside; distance to first order.\n"
      "\nExamples:\n"
      "  blendwright relate part.json box.json\n"
      "  blendwright relate figure.json#bar figure.json#plate --tolerance 1e-6 --json\n"
      "  blendwright relate part.json --points points.csv --tolerance 1e-6 -o places.csv");
  sub->callback([command, &program] { program.code = relate(*command, program.console); });
}

void add_collide(CLI::App& app, Program& program) {
  const auto command = std::make_shared<CollideCommand>();
  CLI::App* sub = verb(app, "collide");
  sub->add_option("SCENES", command->scenes,
                  "scene files, one per body; part.json#node means another node than the scene's solid")
      ->required();
  add_search(sub, command->search);
  CLI::Option* motion = sub->add_option(
      "--motion", command->motion,
      "placements of the bodies: lines of step (or time), body, x, y, z and qw, qx, qy, qz or axis_x, "
      "axis_y, axis_z, angle_deg under a line of these names; - reads standard input");
  sub->add_option("-o,--output", command->output, "file for the answers, .csv, one line per pair");
  sub->add_flag("--all", command->all, "of a motion: tell the disjoint pairs too, not only the others")
      ->needs(motion);
  CLI::Option* projected =
      sub->add_option("--projected", command->projected,
                      "bars through the whole depth along this axis instead of boxes; decides less");
  projected->check(CLI::IsMember({"x", "y", "z"}))->excludes(motion);
  sub->add_option("--cells", command->cells,
                  "file for the subdivision, .vtu or .png, coloured by verdict; may be given again")
      ->allow_extra_args(false)
      ->excludes(motion);
  motion->excludes("--domain");
  sub->add_option("--expect", command->expect, "exit with 1 when the answer is another one")
      ->check(CLI::IsMember({"disjoint", "contact"}));
  sub->add_flag("--convert-units", command->convert_units, "scale scenes to the unit of the first");
  sub->add_flag("--force", command->force, "replace files that exist");
  CLI::Option* json = sub->add_flag("--json", command->json, "print JSON instead of the table");
  sub->add_flag("--times", command->times, "time of each stage in the JSON")->needs(json);
  sub->add_flag("--quiet", command->quiet, "no table, no warnings, no progress");
  add_threads(sub, command->threads);
  sub->footer(
      "\nAnswers: disjoint and in contact are proven; undecided is what remains below the tolerance or "
      "beyond\n"
      "the work limit. Touching is contact, but mostly too close to be decided. Of several pairs and steps,\n"
      "the answer is contact when any is in contact, else undecided when any is. gap > 0 estimates the\n"
      "distance, gap < 0 the depth of penetration, to first order; the normal leads from the first body to\n"
      "the second.\n"
      "Exit code 0: decided either way; 1: a pair is undecided. With --expect: 0 when the answer is the\n"
      "expected one, else 1.\n"
      "\nExamples:\n"
      "  blendwright collide arm.json part.json\n"
      "  blendwright collide arm.json part.json --expect disjoint --quiet\n"
      "  blendwright collide arm.json part.json --cells cells.vtu --cells cells.png\n"
      "  blendwright collide arm.json part.json --motion path.csv -o contacts.csv");
  sub->callback([command, &program] { program.code = collide(*command, program.console); });
}

}  // namespace blendwright
