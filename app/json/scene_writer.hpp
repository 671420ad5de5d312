#pragma once
// A scene file with other numbers.
#include <string>

#include "implicit/scene/node_spec.hpp"

namespace blendwright {

/// `text`, a scene file's own, with every number of `changed` that differs from what it says; comments and
/// layout stay. A number that leaves its range under "adjust" widens the range. Throws as read_scene does,
/// and InputError when the new text does not read back as `changed`.
[[nodiscard]] std::string scene_text(const std::string& text, const SceneSpec& changed);

}  // namespace blendwright
