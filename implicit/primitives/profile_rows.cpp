#include "implicit/scene/node.hpp"

namespace blendwright {

std::span<const NodeKind> profile_kinds() { return {}; }

}  // namespace blendwright
