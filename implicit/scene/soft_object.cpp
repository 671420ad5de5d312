#include "implicit/scene/node.hpp"

namespace blendwright {

std::span<const NodeKind> field_kinds() { return {}; }

}  // namespace blendwright
