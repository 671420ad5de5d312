#pragma once
// The rows of this folder's conversions, group by group; conversion_kinds() joins them in this order.
#include "implicit/scene/node.hpp"

namespace blendwright::detail {

[[nodiscard]] std::span<const NodeKind> zero_level_kinds();  // zero_level
[[nodiscard]] std::span<const NodeKind> convert_kinds();     // convert

}  // namespace blendwright::detail
