#include "app/cli/options.hpp"
#include "app/view/window/window.hpp"

namespace blendwright {

void add_view(CLI::App& app, Program& program) {
  const auto command = std::make_shared<ViewCommand>();
  CLI::App* sub = verb(app, "view");
  sub->add_option(
         "FILE", command->files,
         "job, scene, .step, .vtp, .stl, .obj, .ply, .vtu, or a folder that \"blend\" wrote; two are "
         "shown side by side")
      ->required()
      ->expected(1, 2);
  sub->add_option("--save", command->save,
                  "where Ctrl+S saves the changed file; default: beside it, \"-edited\" added to its name");
  sub->add_flag("--force", command->force, "replace files that exist, without asking");
  sub->add_option("--width", command->width, "of the window, pixels")
      ->capture_default_str()
      ->check(CLI::Range(480, 4096));
  sub->add_option("--height", command->height, "of the window, pixels")
      ->capture_default_str()
      ->check(CLI::Range(360, 4096));
  sub->add_flag("--dark", command->dark, "dark background");
  sub->add_option(
      "--script", command->script,
      "replay events instead, one per line, and print the state after each as a line of JSON; - reads "
      "standard input");
  sub->add_flag("--times", command->times, "say what reshaping and drawing took, apart from each other");
  add_threads(sub, command->threads);
  std::string footer = "\nCommands of a script (positions are pixels from the upper left corner):\n";
  for (const ViewScriptCommand& c : view_script_commands()) {
    std::string left = "  " + std::string(c.name) + " " + std::string(c.arguments);
    left.resize(std::max<std::size_t>(left.size() + 2, 28), ' ');
    footer += left + std::string(c.does) + "\n";
  }
  footer +=
      "\nWithout a display the exit code is 5; \"blendwright picture\" and --script need none.\n"
      "\nExamples:\n"
      "  blendwright view joint.json\n"
      "  blendwright view joint.json out/joint.step\n"
      "  blendwright view joint.json --script events.txt --save changed.json";
  sub->footer(footer);
  sub->callback([command, &program] { program.code = view(*command, program.console); });
}

}  // namespace blendwright
