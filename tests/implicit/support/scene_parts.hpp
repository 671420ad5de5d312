#pragma once
// Short words for scenes in tests.
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "implicit/scene/scene.hpp"
#include "kernel/base/error.hpp"

namespace blendwright::test {

using Values = std::map<std::string, NodeValue>;

inline NodeRef ref(std::string name) { return {std::move(name)}; }
inline std::vector<NodeRef> refs(const std::vector<std::string>& names) {
  std::vector<NodeRef> r;
  for (const std::string& n : names) r.push_back({n});
  return r;
}
inline NodeSpec part(std::string name, std::string kind, Values values = {}) {
  return {.name = std::move(name), .kind = std::move(kind), .values = std::move(values)};
}
inline NodeSpec ball(std::string name, double radius) {
  return part(std::move(name), "lp_metric", {{"a", radius}, {"b", radius}, {"c", radius}, {"n", 2.0}});
}
inline NodeSpec soft(std::string name, const std::string& distance) {
  return part(std::move(name), "soft_object", {{"distance", ref(distance)}});
}
/// The last node is the solid.
inline SceneSpec scene_of(std::vector<NodeSpec> nodes) {
  SceneSpec scene;
  scene.solid = nodes.empty() ? "" : nodes.back().name;
  scene.nodes = std::move(nodes);
  return scene;
}
inline NodeSpec* find(SceneSpec& scene, const std::string& name) {
  for (NodeSpec& n : scene.nodes)
    if (n.name == name) return &n;
  return nullptr;
}

/// What build_scene refuses the scene for; nothing when it builds.
inline std::vector<Problem> problems_of(const SceneSpec& scene) {
  try {
    static_cast<void>(build_scene(scene));
    return {};
  } catch (const InputError& e) {
    return e.problems();
  }
}

}  // namespace blendwright::test
