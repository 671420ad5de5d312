#include "implicit/primitives/primitive_tables.hpp"

namespace blendwright {

std::span<const NodeKind> distance_kinds() {
  static const std::vector<NodeKind> all = [] {
    std::vector<NodeKind> rows;
    for (const auto group : {detail::plane_kinds(), detail::superellipsoid_kinds(),
                             detail::generalized_kinds(), detail::skeleton_kinds(), detail::sweep_kinds()})
      rows.insert(rows.end(), group.begin(), group.end());
    return rows;
  }();
  return all;
}

}  // namespace blendwright
