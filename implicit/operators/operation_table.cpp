#include "implicit/operators/operation_rows.hpp"

namespace blendwright {

std::span<const NodeKind> operation_kinds() {
  static const std::vector<NodeKind> all = [] {
    std::vector<NodeKind> list;
    for (const auto group :
         {detail::soft_kinds(), detail::scale_kinds(), detail::ricci_kinds(), detail::zero_kinds(),
          detail::function_set_kinds(), detail::function_blend_kinds(), detail::function_material_kinds()})
      list.insert(list.end(), group.begin(), group.end());
    return list;
  }();
  return all;
}

}  // namespace blendwright
