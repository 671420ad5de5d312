#include "implicit/scene/node.hpp"

namespace blendwright {

std::span<const NodeKind> distance_operation_kinds() { return {}; }
std::span<const NodeKind> operation_kinds() { return {}; }

}  // namespace blendwright
