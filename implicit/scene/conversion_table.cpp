#include "implicit/scene/scene_tables.hpp"

namespace blendwright {

std::span<const NodeKind> conversion_kinds() {
  static const std::vector<NodeKind> all = [] {
    std::vector<NodeKind> rows;
    for (const auto group : {detail::zero_level_kinds(), detail::convert_kinds()})
      rows.insert(rows.end(), group.begin(), group.end());
    return rows;
  }();
  return all;
}

}  // namespace blendwright
