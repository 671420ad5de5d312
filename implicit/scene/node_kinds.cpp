#include <algorithm>
#include <array>
#include <string>
#include <unordered_map>

#include "implicit/scene/node.hpp"

namespace blendwright {

bool same_origin(const Node& a, const Node& b) {
  return (a.origin - b.origin).norm() <= 1e-12 + 1e-9 * std::max(a.origin.norm(), b.origin.norm());
}

std::string_view name(NodeFamily family) {
  constexpr std::array<std::string_view, 9> names = {"profile",   "distance",   "distance operation",
                                                     "field",     "solid",      "offset",
                                                     "operation", "conversion", "placement"};
  return names[static_cast<std::size_t>(family)];
}

std::span<const NodeKind* const> node_kinds() {
  static const std::vector<const NodeKind*> kinds = [] {
    std::vector<const NodeKind*> all;
    for (const std::span<const NodeKind> family :
         {profile_kinds(), distance_kinds(), distance_operation_kinds(), field_kinds(), solid_kinds(),
          offset_kinds(), operation_kinds(), conversion_kinds(), placement_kinds()})
      for (const NodeKind& kind : family) all.push_back(&kind);
    return all;
  }();
  return kinds;
}

const NodeKind* find_node_kind(std::string_view name) {
  static const std::unordered_map<std::string_view, const NodeKind*> by_name = [] {
    std::unordered_map<std::string_view, const NodeKind*> map;
    for (const NodeKind* kind : node_kinds()) map.emplace(kind->name, kind);
    return map;
  }();
  const auto at = by_name.find(name);
  return at == by_name.end() ? nullptr : at->second;
}

}  // namespace blendwright
