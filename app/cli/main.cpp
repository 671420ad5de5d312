// The command line: the only file that sees CLI11 (which is why it takes longer to compile than the others).
#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

#include "app/cli/arguments.hpp"
#include "app/cli/verbs.hpp"
#include "app/json/choices.hpp"

namespace blendwright {

std::span<const VerbInfo> verbs_table() {
  static constexpr VerbInfo verbs[] = {
      {"blend", "build the blends of a job, write them and verify what was written",
       "blendwright blend joint.json -o out --format step,vtp"},
      {"verify", "build the blends of a job and verify them, in memory",
       "blendwright verify joint.json --tol-angle-deg 0.01"},
      {"mesh", "turn the solid of a scene of soft objects into triangles",
       "blendwright mesh scene.json -o body.vtp -o body.stl --cells 256"},
      {"eval", "evaluate the field of a scene at given points",
       "blendwright eval scene.json --points points.csv -o values.csv"},
      {"offset", "offset, shell, round or fillet the solid of a scene, and mesh the result",
       "blendwright offset scene.json --distance -2 -o smaller.vtp"},
      {"relate", "say how two solids lie to each other, or where points lie",
       "blendwright relate part.json box.json"},
      {"collide", "say whether bodies touch, as they stand or along a motion",
       "blendwright collide arm.json part.json --motion path.csv -o contacts.csv"},
      {"inspect", "list the faces and edges of a STEP file, with selectors to paste into a job",
       "blendwright inspect part.step"},
      {"list", "list what a job or a scene may choose from", "blendwright list primaries"},
      {"schema", "print the JSON Schema of a job, a scene or a report, for editors",
       "blendwright schema job > job.schema.json"}};
  return verbs;
}

namespace {

CLI::App* verb(CLI::App& app, std::string_view name) {
  for (const VerbInfo& v : verbs_table())
    if (v.name == name) {
      CLI::App* sub = app.add_subcommand(std::string(name), std::string(v.summary));
      sub->footer("\nExample:\n  " + std::string(v.example));
      return sub;
    }
  throw std::logic_error("verb without a row in the table");
}

std::string footer() {
  std::string text = "\nExamples:\n";
  for (const VerbInfo& v : verbs_table()) text += "  " + std::string(v.example) + "\n";
  text += "\nExit codes:";
  for (const ExitCode& e : exit_codes)
    text += "  " + std::to_string(e.code) + " " + std::string(e.meaning) + ";";
  text.back() = '\n';
  return text;
}

template <class T>
void optional_number(CLI::App* sub, const char* flag, std::optional<T>& value, const char* help,
                     const CLI::Validator& check) {
  sub->add_option(flag, value, help)->check(check);
}

/// Numbers above zero; the message says that, and no largest double.
CLI::Validator positive() {
  const auto check = [](std::string& text) -> std::string {
    double x = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    if (error != std::errc() || end != text.data() + text.size()) return "is " + text + ", must be a number";
    return x > 0.0 && std::isfinite(x) ? "" : "is " + text + ", must be > 0";
  };
  return CLI::Validator(check, "NUMBER");
}

void add_json(CLI::App* sub, bool& json, bool& times) {
  CLI::Option* flag = sub->add_flag("--json", json, "print the report instead of the table");
  CLI::Option* clock = sub->add_flag("--times", times, "time of each stage in the report");
  if (sub->get_name() == "verify") clock->needs(flag);  // it writes no report
}

void add_threads(CLI::App* sub, std::optional<int>& threads) {
  optional_number(sub, "--threads", threads, "number of threads; the result is the same",
                  CLI::Range(1, 1024));
}

void add_certify(CLI::App* sub, bool& certify) {
  sub->add_flag(
      "--certify", certify,
      "prove bounds of gap, angle and curvature jump between the samples; what is not proven fails");
}

/// A check that is passed when `read` returns; else the message is what its InputError says.
template <class Read>
CLI::Validator readable(Read read, const char* what) {
  return CLI::Validator(
      [read](std::string& text) -> std::string {
        try {
          static_cast<void>(read(text));
          return "";
        } catch (const InputError& e) {
          return e.problems().front().message;
        }
      },
      what);
}

void add_fairness(CLI::App* sub, bool& fairness, std::string& pull) {
  CLI::Option* flag = sub->add_flag("--fairness", fairness, "energies, extremes and turns of the curvature");
  sub->add_option("--pull", pull, "direction x,y,z that a mould opens in: the draft angles along it")
      ->needs(flag)
      ->check(readable(direction_argument, "X,Y,Z"));
}

void add_report(CLI::App* sub, std::string& report) {
  sub->add_option("--report", report,
                  "also write a page for people, .html: verdict, pictures, plots, tables");
}

void add_blend(CLI::App& app, BlendCommand& command, const Console& console, int& code) {
  std::vector<std::string> formats;
  for (const auto& c : format_choices()) formats.emplace_back(c.name);
  CLI::App* sub = verb(app, "blend");
  sub->add_option("JOB", command.job, "job file; - reads standard input")->required();
  sub->add_option("-o,--out,--output", command.folder, "output folder")
      ->capture_default_str()
      ->check(CLI::Validator(
          [](std::string& text) {
            return text.empty() ? std::string("is empty, must be a folder; . is the current one") : "";
          },
          "FOLDER"));
  sub->add_option("--format", command.formats, "formats instead of the job's, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(formats));
  sub->add_flag("--force", command.force, "replace files that exist");
  add_certify(sub, command.certify);
  add_fairness(sub, command.fairness, command.pull);
  add_report(sub, command.report);
  add_json(sub, command.json, command.times);
  sub->add_flag("--quiet", command.quiet, "no table, no warnings, no progress");
  add_threads(sub, command.threads);
  sub->callback([&] { code = blend(command, console); });
}

void add_verify(CLI::App& app, VerifyCommand& command, const Console& console, int& code) {
  CLI::App* sub = verb(app, "verify");
  sub->add_option("JOB", command.job, "job file; - reads standard input")->required();
  optional_number(sub, "--tol-position", command.position, "largest gap, model units", positive());
  optional_number(sub, "--tol-angle-deg", command.angle_deg, "largest angle between tangent planes",
                  positive());
  optional_number(sub, "--tol-curvature", command.curvature, "largest jump of normal curvature, 1/model unit",
                  positive());
  add_certify(sub, command.certify);
  add_fairness(sub, command.fairness, command.pull);
  add_report(sub, command.report);
  sub->add_flag("--force", command.force, "replace a report that exists");
  add_json(sub, command.json, command.times);
  sub->add_flag("--quiet", command.quiet, "no table, no warnings, no progress");
  add_threads(sub, command.threads);
  sub->callback([&] { code = verify(command, console); });
}

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

void add_mesh(CLI::App& app, MeshCommand& command, const Console& console, int& code) {
  CLI::App* sub = verb(app, "mesh");
  add_meshing(sub, command);
  add_report(sub, command.report);
  sub->callback([&] { code = mesh(command, console); });
}

/// Finite numbers.
CLI::Validator finite() {
  const auto check = [](std::string& text) -> std::string {
    double x = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    const bool number = error == std::errc() && end == text.data() + text.size() && std::isfinite(x);
    return number ? "" : "is " + text + ", must be a finite number";
  };
  return CLI::Validator(check, "NUMBER");
}

void add_offset(CLI::App& app, OffsetCommand& command, const Console& console, int& code) {
  CLI::App* sub = verb(app, "offset");
  CLI::Option* distance = sub->add_option("--distance", command.distance,
                                          "offset by this length, model units; > 0 grows the solid");
  CLI::Option* shell = sub->add_option(
      "--shell", command.shell, "keep a wall along the surface: how far it reaches inward and outward");
  CLI::Option* round =
      sub->add_option("--round", command.round, "round convex edges with this radius (opening)");
  CLI::Option* fillet =
      sub->add_option("--fillet", command.fillet, "fillet concave edges with this radius (closing)");
  distance->check(finite())->excludes(shell)->excludes(round)->excludes(fillet);
  shell->check(readable(shell_argument, "INNER,OUTER"))->excludes(round)->excludes(fillet);
  round->check(positive())->excludes(fillet);
  fillet->check(positive());
  sub->add_option("--kind", command.kind,
                  "of --distance: ball has a constant radius, normal moves along the field's gradient, iso "
                  "adds to the field (a value, no length)")
      ->capture_default_str()
      ->check(CLI::IsMember({"ball", "normal", "iso"}))
      ->needs(distance);
  sub->add_option("--tolerance", command.tolerance,
                  "of balls where there is no closed form: how well values are enclosed")
      ->check(positive());
  add_meshing(sub, command.mesh);
  sub->footer(
      "\nThe offset is measured at points of the original surface, moved along their normals: how far the\n"
      "offset surface is from them (> 0: too large), with the place of the worst. Exit code 4: nothing is "
      "left.\n"
      "\nExamples:\n"
      "  blendwright offset scene.json --distance -2 -o smaller.vtp\n"
      "  blendwright offset scene.json --shell 1,0 -o skin.stl --cells 256\n"
      "  blendwright offset scene.json --round 0.5 --json");
  sub->callback([&] { code = offset(command, console); });
}

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

void add_relate(CLI::App& app, RelateCommand& command, const Console& console, int& code) {
  CLI::App* sub = verb(app, "relate");
  sub->add_option("SCENES", command.scenes,
                  "one or two scene files; part.json#node means another node than the scene's solid")
      ->required();
  add_search(sub, command.search);
  CLI::Option* points =
      sub->add_option("--points", command.points,
                      "say where these points lie instead: .vtp or lines of x, y, z; - reads standard input");
  sub->add_option("--mode", command.mode,
                  "a point is on the surface when: value, |phi| <= tolerance; length, the same over |grad "
                  "phi|; guaranteed, phi may be 0 within the tolerance around it")
      ->capture_default_str()
      ->check(CLI::IsMember({"value", "length", "guaranteed"}))
      ->needs(points);
  sub->add_flag("--confirm", command.confirm, "on the surface only where the outside is near")->needs(points);
  CLI::Option* output =
      sub->add_option("-o,--output", command.output, "file for the points, .csv")->needs(points);
  sub->add_flag("--convert-units", command.convert_units, "scale the second scene to the unit of the first");
  sub->add_flag("--force", command.force, "replace a file that exists");
  sub->add_flag("--json", command.json, "print JSON instead of the table")
      ->excludes(output)
      ->excludes(points);
  sub->add_flag("--quiet", command.quiet, "no table, no warnings, no progress");
  add_threads(sub, command.threads);
  sub->footer(
      "\nEvery statement comes with its proof: proven, refuted by a witness point, or undecided.\n"
      "Exit code 0: decided; 1: undecided. Points print x,y,z,s2,s3,phi,distance: s2 1 in the closed solid,\n"
      "s3 0 outside, 1 on the surface, 2 inside; phi > 0 inside; distance to first order.\n"
      "\nExamples:\n"
      "  blendwright relate part.json box.json\n"
      "  blendwright relate figure.json#bar figure.json#plate --tolerance 1e-6 --json\n"
      "  blendwright relate part.json --points points.csv --tolerance 1e-6 -o places.csv");
  sub->callback([&] { code = relate(command, console); });
}

void add_collide(CLI::App& app, CollideCommand& command, const Console& console, int& code) {
  CLI::App* sub = verb(app, "collide");
  sub->add_option("SCENES", command.scenes,
                  "scene files, one per body; part.json#node means another node than the scene's solid")
      ->required();
  add_search(sub, command.search);
  CLI::Option* motion = sub->add_option(
      "--motion", command.motion,
      "placements of the bodies: lines of step (or time), body, x, y, z and qw, qx, qy, qz or axis_x, "
      "axis_y, axis_z, angle_deg under a line of these names; - reads standard input");
  sub->add_option("-o,--output", command.output, "file for the answers, .csv, one line per pair");
  sub->add_flag("--all", command.all, "of a motion: tell the disjoint pairs too, not only the others")
      ->needs(motion);
  CLI::Option* projected =
      sub->add_option("--projected", command.projected,
                      "bars through the whole depth along this axis instead of boxes; decides less");
  projected->check(CLI::IsMember({"x", "y", "z"}))->excludes(motion);
  sub->add_option("--cells", command.cells,
                  "file for the subdivision, .vtu or .png, coloured by verdict; may be given again")
      ->allow_extra_args(false)
      ->excludes(motion);
  motion->excludes("--domain");
  sub->add_option("--expect", command.expect, "exit with 1 when the answer is another one")
      ->check(CLI::IsMember({"disjoint", "contact"}));
  sub->add_flag("--convert-units", command.convert_units, "scale scenes to the unit of the first");
  sub->add_flag("--force", command.force, "replace files that exist");
  CLI::Option* json = sub->add_flag("--json", command.json, "print JSON instead of the table");
  sub->add_flag("--times", command.times, "time of each stage in the JSON")->needs(json);
  sub->add_flag("--quiet", command.quiet, "no table, no warnings, no progress");
  add_threads(sub, command.threads);
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
  sub->callback([&] { code = collide(command, console); });
}

void add_eval(CLI::App& app, EvalCommand& command, const Console& console, int& code) {
  CLI::App* sub = verb(app, "eval");
  sub->add_option("SCENE", command.scene, "scene file; - reads standard input")->required();
  sub->add_option("--points", command.points,
                  "points, as .vtp or as lines of x, y, z; - reads standard input")
      ->required();
  sub->add_option("--solid", command.solid, "node to evaluate instead of the scene's solid");
  CLI::Option* output = sub->add_option("-o,--output", command.output, "file to write, .csv or .vtp");
  sub->add_flag("--force", command.force, "replace a file that exists");
  sub->add_flag("--json", command.json, "print JSON instead of lines")->excludes(output);
  sub->add_flag("--quiet", command.quiet, "no summary, no warnings, no progress");
  add_threads(sub, command.threads);
  sub->callback([&] { code = eval(command, console); });
}

void add_inspect(CLI::App& app, InspectCommand& command, const Console& console, int& code) {
  CLI::App* sub = verb(app, "inspect");
  sub->add_option("PART", command.part, "STEP file")->required();
  sub->add_flag("--json", command.json, "print JSON");
  sub->callback([&] { code = inspect(command, console); });
}

void add_list(CLI::App& app, ListCommand& command, const Console& console, int& code) {
  CLI::App* sub = verb(app, "list");
  sub->add_option("FAMILY", command.family, "what to list; without it, what there is to list")
      ->check(CLI::IsMember(listed_families()));
  sub->add_flag("--json", command.json, "print JSON");
  sub->callback([&] { code = list(command, console); });
}

void add_schema(CLI::App& app, SchemaCommand& command, const Console& console, int& code) {
  CLI::App* sub = verb(app, "schema");
  sub->add_option("OF", command.of, "job, scene or report")
      ->required()
      ->check(CLI::IsMember({"job", "scene", "report"}));
  sub->callback([&] { code = schema(command, console); });
}

int run(int argc, char** argv) {
  const Console console = Console::of_process();
  CLI::App app{
      "Makes and proves blend surfaces between CAD surfaces, meshes implicit solids, and decides whether "
      "they touch.",
      "blendwright"};
  app.set_version_flag("--version", "blendwright " BLENDWRIGHT_VERSION);
  app.require_subcommand(1);
  app.footer(footer());
  int code = exit_done;
  BlendCommand blend_command;
  VerifyCommand verify_command;
  MeshCommand mesh_command;
  EvalCommand eval_command;
  OffsetCommand offset_command;
  RelateCommand relate_command;
  CollideCommand collide_command;
  InspectCommand inspect_command;
  ListCommand list_command;
  SchemaCommand schema_command;
  add_blend(app, blend_command, console, code);
  add_verify(app, verify_command, console, code);
  add_mesh(app, mesh_command, console, code);
  add_eval(app, eval_command, console, code);
  add_offset(app, offset_command, console, code);
  add_relate(app, relate_command, console, code);
  add_collide(app, collide_command, console, code);
  add_inspect(app, inspect_command, console, code);
  add_list(app, list_command, console, code);
  add_schema(app, schema_command, console, code);
  blend_command.called = verify_command.called = mesh_command.called = command_line(argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e, console.out(), console.err()) == 0 ? exit_done : exit_usage;
  }
  return code;
}

}  // namespace
}  // namespace blendwright

int main(int argc, char** argv) {
  try {
    return blendwright::run(argc, argv);
  } catch (const std::exception& e) {
    std::cerr << "blendwright: unexpected error, please report it: " << e.what() << '\n';
    return blendwright::exit_no_result;
  } catch (...) {
    std::cerr << "blendwright: unexpected error, please report it\n";
    return blendwright::exit_no_result;
  }
}
