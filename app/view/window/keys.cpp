#include "app/view/window/keys.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace blendwright {
namespace {

constexpr ViewKey keys[] = {{ViewAction::help, "H", "?", "shows or hides this help"},
                            {ViewAction::plain, "1", "", "colours: plain"},
                            {ViewAction::gap, "2", "", "colours: gap"},
                            {ViewAction::angle, "3", "", "colours: angle"},
                            {ViewAction::curvature, "4", "", "colours: mean curvature"},
                            {ViewAction::zebra, "5", "", "colours: zebra stripes"},
                            {ViewAction::isophotes, "6", "", "colours: isophotes"},
                            {ViewAction::draft, "7", "", "colours: draft along z"},
                            {ViewAction::radius, "8", "", "colours: least radius"},
                            {ViewAction::deviation, "9", "", "colours: deviation"},
                            {ViewAction::field, "0", "", "colours: field of a scene"},
                            {ViewAction::next_mode, "C", "", "colours: the next of these"},
                            {ViewAction::comb, "K", "", "curvature combs on or off"},
                            {ViewAction::handles, "T", "", "handles on or off"},
                            {ViewAction::primaries, "G", "", "primaries on or off"},
                            {ViewAction::dark, "B", "", "white or dark background"},
                            {ViewAction::fit, "F", "", "fits the object into the window"},
                            {ViewAction::along_x, "X", "", "looks along x"},
                            {ViewAction::along_y, "Y", "", "looks along y"},
                            {ViewAction::along_z, "Z", "", "looks along z"},
                            {ViewAction::next_blend, "Tab", "", "sliders of the next blend or file"},
                            {ViewAction::next_page, "N", "Next", "more sliders"},
                            {ViewAction::undo, "Ctrl+Z", "", "takes back the last change"},
                            {ViewAction::redo, "Ctrl+Y", "", "makes it again"},
                            {ViewAction::save, "Ctrl+S", "", "saves the changed file"},
                            {ViewAction::picture, "P", "", "saves a picture of the window"},
                            {ViewAction::step, "E", "", "exports STEP"},
                            {ViewAction::escape, "Escape", "", "closes the help; forgets what was picked"},
                            {ViewAction::quit, "Q", "", "ends"}};

constexpr ViewGesture gestures[] = {{"left drag", "a slider or a handle; else turns"},
                                    {"Shift drag", "bends a trimline at its handle"},
                                    {"click", "picks a point"},
                                    {"middle drag", "moves the view"},
                                    {"wheel", "zooms"}};

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

constexpr std::string_view control_mark = "ctrl+";

bool same_key(std::string_view written, const std::string& symbol, bool control) {
  if (written.empty()) return false;
  const TypedKey key = typed_key(std::string(written));
  return key.control == control && lower(key.symbol) == lower(symbol);
}

}  // namespace

std::span<const ViewKey> view_keys() { return keys; }
std::span<const ViewGesture> view_gestures() { return gestures; }

TypedKey typed_key(const std::string& written) {
  const std::string small = lower(written);
  TypedKey key{written, small.rfind(control_mark, 0) == 0, false};
  if (key.control) key.symbol = written.substr(control_mark.size());
  if (key.symbol == "?") key.symbol = "question";
  return key;
}

std::optional<ViewAction> action_of(const std::string& key, bool control) {
  for (const ViewKey& row : keys)
    if (same_key(row.key, key, control) || same_key(row.also, key, control)) return row.action;
  return std::nullopt;
}

}  // namespace blendwright
