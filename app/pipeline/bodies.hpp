#pragma once
// Several solids of scene files, side by side in one unit of length.
#include <span>
#include <string>
#include <vector>

#include "app/json/scene_reader.hpp"

namespace blendwright {

/// "part.json" or "part.json#node".
struct SolidPlace {
  std::string file, solid;  ///< solid empty: the scene's
};
/// A file whose whole name is `text` comes first; else the part behind the last # names a node.
[[nodiscard]] SolidPlace solid_place(const std::string& text);

struct Body {
  std::string name;  ///< stem of the file, "part#node" when the node was named
  SceneFile scene;
};
[[nodiscard]] Body read_body(const SolidPlace& place);
/// Bodies of the same name become "part", "part (2)", ...
void make_names_unique(std::vector<Body>& bodies);

/// Lengths are compared, so all bodies must be in the unit of the first. Throws InputError naming the others,
/// or, when `convert`, scales them to the first one's unit and says so for each.
[[nodiscard]] std::vector<std::string> to_unit_of_first(std::span<Body> bodies, bool convert);

}  // namespace blendwright
