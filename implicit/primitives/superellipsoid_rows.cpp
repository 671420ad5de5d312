#include "implicit/primitives/primitive_tables.hpp"

namespace blendwright::detail {

std::span<const NodeKind> superellipsoid_kinds() { return {}; }

}  // namespace blendwright::detail
