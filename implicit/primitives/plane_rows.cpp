#include "implicit/primitives/primitive_tables.hpp"

namespace blendwright::detail {

std::span<const NodeKind> plane_kinds() { return {}; }

}  // namespace blendwright::detail
