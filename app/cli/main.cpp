// The command line: the verbs' table, the smaller verbs, and the process.
#include "app/cli/arguments.hpp"
#include "app/cli/options.hpp"

namespace blendwright {

std::span<const VerbInfo> verbs_table() {
  static constexpr VerbInfo verbs[] = {
      {"blend", "build the blends of a job, write them and verify what was written",
       "blendwright blend joint.json -o out --format step,vtp"},
      {"verify", "build the blends of a job and verify them, in memory",
       "blendwright verify joint.json --tol-angle-deg 0.01"},
      {"fit", "find the shape that a job asks for, and write the job that has it",
       "blendwright fit joint.json -o fitted.json --report fit.html"},
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
      {"compare", "say how far two results are from each other: jobs, STEP files, meshes",
       "blendwright compare joint.json out/joint.step --limit 1e-6"},
      {"picture", "draw a job, a scene, a STEP file or a mesh, coloured by what is to be judged",
       "blendwright picture joint.json -o joint.png --show zebra"},
      {"view", "show files in a window; shape jobs and scenes with sliders",
       "blendwright view joint.json"},
      {"inspect", "list the faces and edges of a STEP file, with selectors to paste into a job",
       "blendwright inspect part.step"},
      {"list", "list what a job or a scene may choose from", "blendwright list primaries"},
      {"schema", "print the JSON Schema of a job, a scene or a report, for editors",
       "blendwright schema job > job.schema.json"}};
  return verbs;
}

namespace {

std::string footer() {
  std::string text = "\nExamples:\n";
  for (const VerbInfo& v : verbs_table()) text += "  " + std::string(v.example) + "\n";
  text += "\nExit codes:";
  for (const ExitCode& e : exit_codes)
    text += "  " + std::to_string(e.code) + " " + std::string(e.meaning) + ";";
  text.back() = '\n';
  return text;
}

void add_inspect(CLI::App& app, Program& program) {
  const auto command = std::make_shared<InspectCommand>();
  CLI::App* sub = verb(app, "inspect");
  sub->add_option("PART", command->part, "STEP file")->required();
  sub->add_flag("--json", command->json, "print JSON");
  sub->callback([command, &program] { program.code = inspect(*command, program.console); });
}

void add_list(CLI::App& app, Program& program) {
  const auto command = std::make_shared<ListCommand>();
  CLI::App* sub = verb(app, "list");
  sub->add_option("FAMILY", command->family, "what to list; without it, what there is to list")
      ->check(CLI::IsMember(listed_families()));
  sub->add_flag("--json", command->json, "print JSON");
  sub->callback([command, &program] { program.code = list(*command, program.console); });
}

void add_schema(CLI::App& app, Program& program) {
  const auto command = std::make_shared<SchemaCommand>();
  CLI::App* sub = verb(app, "schema");
  sub->add_option("OF", command->of, "job, scene, report or fit-report")
      ->required()
      ->check(CLI::IsMember({"job", "scene", "report", "fit-report"}));
  sub->callback([command, &program] { program.code = schema(*command, program.console); });
}

int run(int argc, char** argv) {
  CLI::App app{
      "Makes and proves blend surfaces between CAD surfaces, meshes implicit solids, and decides whether "
      "they touch.",
      "blendwright"};
  app.set_version_flag("--version", "blendwright " BLENDWRIGHT_VERSION);
  app.require_subcommand(1);
  app.footer(footer());
  Program program{.console = Console::of_process(), .called = command_line(argc, argv)};
  add_blend(app, program);
  add_verify(app, program);
  add_fit(app, program);
  add_mesh(app, program);
  add_eval(app, program);
  add_offset(app, program);
  add_relate(app, program);
  add_collide(app, program);
  add_compare(app, program);
  add_picture(app, program);
  add_view(app, program);
  add_inspect(app, program);
  add_list(app, program);
  add_schema(app, program);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e, program.console.out(), program.console.err()) == 0 ? exit_done : exit_usage;
  }
  return program.code;
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
