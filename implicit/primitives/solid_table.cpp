#include "implicit/primitives/primitive_tables.hpp"

namespace blendwright {

std::span<const NodeKind> solid_kinds() {
  static const std::vector<NodeKind> all = [] {
    std::vector<NodeKind> rows;
    for (const auto group : {detail::quadric_kinds(), detail::solid_distance_kinds()})
      rows.insert(rows.end(), group.begin(), group.end());
    return rows;
  }();
  return all;
}

}  // namespace blendwright
