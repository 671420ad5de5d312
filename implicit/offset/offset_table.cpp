#include "implicit/scene/node.hpp"

namespace blendwright {

std::span<const NodeKind> offset_kinds() { return {}; }

}  // namespace blendwright
