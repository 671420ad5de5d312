#pragma once
// Private: what the keys do. The help on screen, README and the controller read one table.
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace blendwright {

enum class ViewAction {
  help,
  plain,
  gap,
  angle,
  curvature,
  zebra,
  isophotes,
  draft,
  radius,
  deviation,
  field,
  next_mode,
  comb,
  handles,
  primaries,
  dark,
  fit,
  along_x,
  along_y,
  along_z,
  next_blend,
  next_page,
  undo,
  redo,
  save,
  picture,
  step,
  escape,
  quit
};

struct ViewKey {
  ViewAction action;
  std::string_view key;   ///< as it is shown and as scripts write it: "Ctrl+Z", "F", "?"
  std::string_view also;  ///< another key for it; empty: none
  std::string_view does;
};
[[nodiscard]] std::span<const ViewKey> view_keys();

/// What the mouse does; for the help.
struct ViewGesture {
  std::string_view gesture, does;
};
[[nodiscard]] std::span<const ViewGesture> view_gestures();

/// The action of a key by its X name ("z", "question", "Escape"), or as the table writes it.
[[nodiscard]] std::optional<ViewAction> action_of(const std::string& key, bool control);

/// A key as scripts write it: "Ctrl+Z" is z with control.
struct TypedKey {
  std::string symbol;  ///< as X names it
  bool control = false, shift = false;
};
[[nodiscard]] TypedKey typed_key(const std::string& written);

}  // namespace blendwright
