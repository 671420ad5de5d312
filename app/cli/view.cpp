#include <fstream>
#include <iostream>
#include <iterator>

#include "app/cli/verbs.hpp"
#include "app/json/json_value.hpp"
#include "app/view/window/window.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/base/text_file.hpp"
#include "kernel/exchange/picture.hpp"

namespace blendwright {
namespace {

constexpr std::size_t largest_script = std::size_t{16} << 20;

std::string script_text(const std::string& file) {
  if (file != "-") return read_text_file(file, largest_script);
  return {std::istreambuf_iterator<char>(std::cin), {}};
}

/// Said before anything is built: a person would wait for nothing.
void require_window(const ViewCommand& command) {
  const std::string why = why_no_window();
  if (why.empty()) return;
  throw IoError("no window can be shown: " + why + "\n  pictures need none: blendwright picture " +
                command.files.front() +
                " -o view.png\n  events can be replayed without one: --script FILE (Xvfb is started then)");
}

void print_times(const Console& console, const WindowTimes& times) {
  const auto mean = [](double seconds, std::size_t count) {
    return count > 0 ? number_text(1e3 * seconds / static_cast<double>(count), 3) : std::string("0");
  };
  console.err() << times.reshapes << " reshapes, " << mean(times.reshape_seconds, times.reshapes)
                << " ms each (computation); " << times.draws << " frames, "
                << mean(times.draw_seconds, times.draws) << " ms each (drawing)\n";
}

}  // namespace

int view(const ViewCommand& command, const Console& console) {
  std::string subject = shown_name(command.files.front());  // whose problems are told
  return guarded(console, subject, [&] {
    std::optional<ThreadLimit> limit;
    if (command.threads) limit.emplace(*command.threads);
    WindowOptions options{.width = command.width,
                          .height = command.height,
                          .save = command.save,
                          .replace = command.force,
                          .dark = command.dark,
                          .times = command.times};
    std::optional<Display> display;
    if (command.script.empty()) {
      require_window(command);
    } else {
      options.script = script_text(command.script);
      display.emplace();
      if (!display->available()) throw IoError("no window can be opened: " + display->reason());
    }
    std::vector<std::unique_ptr<Document>> documents;
    {
      Run run(console, false);  // Ctrl-C ends the reading; later it ends the program as usual
      for (const std::string& file : command.files) {
        subject = shown_name(file);
        documents.push_back(open_document(file, run.progress()));
      }
    }
    if (!command.script.empty()) subject = shown_name(command.script);
    const WindowTimes times = show_window(std::move(documents), options, console.out());
    if (command.times) print_times(console, times);
    return exit_done;
  });
}

}  // namespace blendwright
