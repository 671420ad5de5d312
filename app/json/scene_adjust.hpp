#pragma once
// The numbers of a scene that its file marks as adjustable: "adjust": {"bar/a": [4, 12], "blend/r/0": [2,
// 8]}.
#include <optional>
#include <string>
#include <vector>

#include "implicit/scene/node_spec.hpp"

namespace blendwright {

struct JsonValue;
class Reading;

/// A number of a node, or one of a list, and the range in which people move it.
struct SceneAdjust {
  std::string name;  ///< as the file has it: "bar/a", "blend/r/0", "/nodes/body/of/1/radius"
  std::string node, key;
  std::optional<std::size_t> index{};  ///< of a list
  Interval range{};
  double fallback = 0.0;  ///< what a key stands for that the node leaves out
};

/// Reads the value of the key "adjust" at `where` against the scene's nodes. Problems: names that are none
/// (with the nearest), values that are no numbers or count things, ranges that are crossed, leave what the
/// key may be, or leave out the scene's own value.
[[nodiscard]] std::vector<SceneAdjust> read_adjust(const JsonValue& value, const std::string& where,
                                                   const SceneSpec& spec, Reading& reading);

[[nodiscard]] double adjusted_number(const SceneSpec& spec, const SceneAdjust& adjust);
[[nodiscard]] SceneSpec with_number(SceneSpec spec, const SceneAdjust& adjust, double value);

}  // namespace blendwright
