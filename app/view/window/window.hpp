#pragma once
// The viewer's window: shows documents and lets them be changed by hand. It needs an X display.
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/view/window/document.hpp"

namespace blendwright {

class Controller;

struct WindowOptions {
  int width = 1280, height = 960;
  std::filesystem::path save{};         ///< where Ctrl+S saves; empty: beside the file, "-edited" added
  bool replace = false;                 ///< files that exist, without asking
  bool dark = false;                    ///< background
  bool times = false;                   ///< tell what reshaping and drawing took
  std::optional<std::string> script{};  ///< events to replay instead of those of a person
};

/// Time spent so far, apart from each other.
struct WindowTimes {
  std::size_t reshapes = 0, draws = 0;
  double reshape_seconds = 0.0, draw_seconds = 0.0;
};

/// Shows one document, or two side by side, until it is closed or the script ends. A script's states go to
/// `states`, one JSON object per line. Throws InputError (the script's lines, all of them at once; a slider
/// that is not there), IoError.
WindowTimes show_window(std::vector<std::unique_ptr<Document>> documents, const WindowOptions& options,
                        std::ostream& states);

/// A row of the commands of scripts; positions are pixels from the upper left corner, as in pictures.
struct ViewScriptCommand {
  std::string_view name, arguments, does;
};
[[nodiscard]] std::span<const ViewScriptCommand> view_script_commands();

/// Why no window can be shown; empty: one can. Looks at the display that DISPLAY names.
[[nodiscard]] std::string why_no_window();

}  // namespace blendwright
