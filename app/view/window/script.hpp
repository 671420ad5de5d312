#pragma once
// Private: events to replay, one per line (view_script_commands()); "#" begins a comment.
#include <iosfwd>
#include <string>
#include <vector>

#include "app/view/window/controller.hpp"

namespace blendwright {

class ViewWindow;

struct ScriptStep {
  std::size_t line = 0;
  std::string command;
  std::vector<std::string> words;  ///< after the command
};

/// Throws InputError with every line that is not in order ("line 3").
[[nodiscard]] std::vector<ScriptStep> read_script(const std::string& text);
/// After each step one line of JSON with the state. Throws InputError ("line 3") for a slider or handle that
/// is not there, IoError.
void run_script(const std::vector<ScriptStep>& steps, ViewWindow& window, Controller& controller, bool times,
                std::ostream& states);

}  // namespace blendwright
