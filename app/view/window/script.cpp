#include "app/view/window/script.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>

#include "app/json/json_value.hpp"
#include "app/view/window/view_state_json.hpp"
#include "app/view/window/view_window.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

constexpr int drag_steps = 6;

constexpr ViewScriptCommand commands[] = {
    {"drag", "SLIDER VALUE", "drags a slider (its name in quotes, or its label) to a value"},
    {"drag-handle", "INDEX DX DY", "drags a handle of the shown blend by pixels"},
    {"bend-handle", "INDEX DX DY", "the same with Shift held: a trimline moves here only"},
    {"click", "X Y", "clicks"},
    {"orbit", "DX DY", "drags the background with the left button, from the middle of the first pane"},
    {"pan", "DX DY", "the same with the middle button"},
    {"wheel", "STEPS", "turns the wheel over the middle of the first pane; > 0: nearer"},
    {"key", "KEY", "presses a key, written as the help shows it: F, Ctrl+Z"},
    {"resize", "WIDTH HEIGHT", "changes the size of the window"},
    {"screenshot", "FILE", "writes what the window shows, as PNG"},
    {"save", "FILE", "saves the changed file; an existing one only with --force"},
    {"drawing", "on|off",
     "off: events are handled, the window is not drawn again until it is on; for long scripts"},
    {"state", "", "prints the state"},
    {"quit", "", "ends; the end of the script does so too"}};

const ViewScriptCommand* command_named(const std::string& name) {
  for (const ViewScriptCommand& c : commands)
    if (c.name == name) return &c;
  return nullptr;
}

std::size_t count_words(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::size_t count = 0;
  for (std::string word; in >> word;) ++count;
  return count;
}

/// Words at blanks; a word in double quotes may contain blanks.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < line.size();) {
    if (line[i] == '#') break;
    if (std::isspace(static_cast<unsigned char>(line[i])) != 0) {
      ++i;
      continue;
    }
    const bool quoted = line[i] == '"';
    const std::size_t from = quoted ? i + 1 : i;
    std::size_t to = from;
    while (to < line.size() &&
           (quoted ? line[to] != '"' : std::isspace(static_cast<unsigned char>(line[to])) == 0))
      ++to;
    words.push_back(line.substr(from, to - from));
    i = quoted ? to + 1 : to;
  }
  return words;
}

std::optional<double> number_of(const std::string& word) {
  try {
    std::size_t used = 0;
    const double x = std::stod(word, &used);
    if (used == word.size() && std::isfinite(x)) return x;
  } catch (const std::exception&) {
    return std::nullopt;
  }
  return std::nullopt;
}

/// Arguments that are numbers, by their place.
bool is_number(std::string_view argument) {
  return argument == "X" || argument == "Y" || argument == "DX" || argument == "DY" || argument == "VALUE" ||
         argument == "INDEX" || argument == "STEPS" || argument == "WIDTH" || argument == "HEIGHT";
}

std::string problem_of(const ScriptStep& step) {
  const ViewScriptCommand* command = command_named(step.command);
  if (!command) {
    std::vector<std::string> names;
    for (const ViewScriptCommand& c : commands) names.emplace_back(c.name);
    const auto near = nearest_word(step.command, names.data(), names.size());
    return "is " + in_quotes(step.command) + ", must be a command" +
           (near ? "; did you mean \"" + *near + "\"?" : "; \"blendwright view --help\" lists them");
  }
  if (count_words(command->arguments) != step.words.size())
    return "has " + std::to_string(step.words.size()) + " arguments, must be " + std::string(command->name) +
           " " + std::string(command->arguments);
  std::istringstream arguments{std::string(command->arguments)};
  std::size_t i = 0;
  for (std::string argument; arguments >> argument; ++i)
    if (is_number(argument) && !number_of(step.words[i]))
      return argument + " is " + in_quotes(step.words[i]) + ", must be a number";
  if (step.command == "key") {
    const TypedKey key = typed_key(step.words[0]);
    if (!action_of(key.symbol, key.control))
      return "key " + in_quotes(step.words[0]) + " does nothing, must be one of the help (H)";
  }
  if (step.command == "drawing" && step.words[0] != "on" && step.words[0] != "off")
    return "drawing is " + in_quotes(step.words[0]) + ", must be on or off";
  if (step.command == "resize" &&
      (*number_of(step.words[0]) < least_window_width || *number_of(step.words[1]) < least_window_height ||
       *number_of(step.words[0]) > 4096 || *number_of(step.words[1]) > 4096))
    return "size must be " + std::to_string(least_window_width) + " x " +
           std::to_string(least_window_height) + " to 4096 x 4096 pixels";
  return "";
}

Vec2 middle(const PixelBox& box) { return {0.5 * (box.left + box.right), 0.5 * (box.bottom + box.top)}; }

class Replay {
 public:
  Replay(ViewWindow& window, Controller& controller) : window_(window), controller_(controller) {}

  void step(const ScriptStep& s) {
    const auto number = [&](std::size_t i) { return *number_of(s.words[i]); };
    const auto point = [&](std::size_t i) { return Vec2(number(i), number(i + 1)); };
    if (s.command == "drag") slider(s.words[0], number(1));
    if (s.command == "drag-handle") handle(number(0), point(1), false);
    if (s.command == "bend-handle") handle(number(0), point(1), true);
    if (s.command == "click") click(point(0));
    if (s.command == "orbit") drag(Event::left_down, Event::left_up, empty_place(), point(0));
    if (s.command == "pan") drag(Event::middle_down, Event::middle_up, pane_middle(), point(0));
    if (s.command == "wheel") wheel(number(0));
    if (s.command == "key") window_.send(Event::key, pane_middle(), typed_key(s.words[0]));
    if (s.command == "resize") window_.resize(static_cast<int>(number(0)), static_cast<int>(number(1)));
    if (s.command == "drawing") window_.set_drawing(s.words[0] == "on");
    if (s.command == "screenshot") window_.write_png(s.words[0]);
    if (s.command == "save") controller_.save(s.words[0], false);
  }

 private:
  using Event = ViewWindow::Event;
  [[nodiscard]] Vec2 pane_middle() const { return middle(controller_.layout().panes.front()); }

  /// A place of the pane without a handle near it.
  [[nodiscard]] Vec2 empty_place() const {
    const PixelBox pane = controller_.layout().panes.front();
    for (double x = 0.5; x < 0.99; x += 0.05) {
      const Vec2 at(pane.left + x * pane.width(), 0.5 * (pane.bottom + pane.top));
      if (!handle_at(at, controller_.handles(), controller_.state().camera, pane, 20.0)) return at;
    }
    return {pane.left + 2.0, pane.bottom + 2.0};
  }

  /// `by` is downwards positive, the window's pixels upwards.
  void drag(Event down, Event up, const Vec2& from, const Vec2& by, bool shift = false) {
    window_.send(down, from, TypedKey{.symbol = {}, .shift = shift});
    for (int i = 1; i <= drag_steps; ++i)
      window_.send(Event::move, from + Vec2(by.x(), -by.y()) * i / drag_steps);
    window_.send(up, from + Vec2(by.x(), -by.y()));
  }

  void slider(const std::string& name, double value) {
    const PixelBox track = controller_.reveal(name);
    const auto find = [&] {
      return *std::find_if(controller_.controls().begin(), controller_.controls().end(),
                           [&](const SessionControl& c) { return c.name == name || c.label == name; });
    };
    SessionControl wanted = find();
    const Vec2 from(Controller::pixel_of(wanted, track), 0.5 * (track.bottom + track.top));
    wanted.value = std::clamp(value, wanted.low, wanted.high);
    if (wanted.kind == SessionControl::Kind::choice) wanted.value = std::round(wanted.value);
    const Vec2 to(Controller::pixel_of(wanted, track), from.y());
    if (wanted.kind == SessionControl::Kind::choice) {
      window_.send(Event::left_down, to);
      window_.send(Event::left_up, to);
    } else {
      drag(Event::left_down, Event::left_up, from, to - from);
    }
  }

  void handle(double index, const Vec2& by, bool shift) {
    std::vector<SessionHandle> shown;
    for (const SessionHandle& h : controller_.handles())
      if (h.blend == controller_.state().group) shown.push_back(h);
    if (index < 0.0 || index >= static_cast<double>(shown.size()))
      throw InputError("", "there is no handle " + number_text(index) + ", must be 0 to " +
                               std::to_string(shown.size()) + " (exclusive)");
    const PixelBox pane = controller_.layout().panes[controller_.state().active];
    drag(Event::left_down, Event::left_up,
         controller_.state().camera.pixel(shown[static_cast<std::size_t>(index)].position, pane), by, shift);
  }

  void click(const Vec2& at) {
    const Vec2 up(at.x(), controller_.state().height - 1.0 - at.y());
    window_.send(Event::left_down, up);
    window_.send(Event::left_up, up);
  }

  void wheel(double steps) {
    for (int i = 0; i < static_cast<int>(std::abs(steps)); ++i)
      window_.send(steps > 0.0 ? Event::wheel_forward : Event::wheel_backward, pane_middle());
  }

  ViewWindow& window_;
  Controller& controller_;
};

}  // namespace

std::span<const ViewScriptCommand> view_script_commands() { return commands; }

std::vector<ScriptStep> read_script(const std::string& text) {
  std::vector<ScriptStep> steps;
  std::vector<Problem> problems;
  std::istringstream in(text);
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::vector<std::string> words = words_of(line);
    if (words.empty()) continue;
    ScriptStep step{number, words.front(), {words.begin() + 1, words.end()}};
    if (const std::string problem = problem_of(step); !problem.empty())
      problems.push_back({"line " + std::to_string(number), problem});
    steps.push_back(std::move(step));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return steps;
}

void run_script(const std::vector<ScriptStep>& steps, ViewWindow& window, Controller& controller, bool times,
                std::ostream& states) {
  Replay replay(window, controller);
  for (const ScriptStep& step : steps) {
    if (step.command == "quit") break;
    try {
      replay.step(step);
    } catch (const InputError& e) {
      throw InputError("line " + std::to_string(step.line), e.problems().front().message);
    }
    states << view_state_line(controller, step.command, times ? &window.times() : nullptr) << '\n';
    if (controller.ended()) break;
  }
}

}  // namespace blendwright
