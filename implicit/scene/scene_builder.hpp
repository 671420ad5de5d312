#pragma once
// The work of build_scene, step by step.
#include <string>
#include <utility>
#include <vector>

#include "implicit/scene/made_nodes.hpp"
#include "implicit/scene/node_values.hpp"
#include "implicit/scene/scene_graph.hpp"

namespace blendwright::detail {

/// Distance operations may be put into each other this deep: each of them looks at what it is made of in many
/// directions before it exists.
inline constexpr std::size_t most_distance_operations = 64;
/// So may offsets, each of which looks at what it is made of at every evaluation.
inline constexpr std::size_t most_offsets = 16;

class SceneBuilder {
 public:
  /// Checks everything and makes the nodes; throws InputError with every problem.
  explicit SceneBuilder(const SceneSpec& spec);

  [[nodiscard]] const Node& solid() const { return *made_.node(made_index_[solid_]); }
  [[nodiscard]] std::optional<Box> bounds();
  /// The primitives whose surfaces make up the solid's: soft objects, and distances that are used without a
  /// potential.
  [[nodiscard]] std::vector<std::string> mark_members();
  [[nodiscard]] std::shared_ptr<const Tape> tape();
  [[nodiscard]] std::vector<Problem> warnings() const { return in_order(warnings_); }

 private:
  using Found = std::vector<std::pair<std::size_t, Problem>>;  ///< the node's number first

  void check_names();
  void check_nodes();
  void check_links(std::size_t node, const std::vector<NodeLink>& links);
  void check_cycles(const MakingOrder& order);
  void make(std::size_t node);
  void check_solid();
  void problem(std::size_t node, const std::string& path, std::string message);
  [[nodiscard]] bool is_placement(std::size_t node) const;
  [[nodiscard]] static std::vector<Problem> in_order(Found found);

  const SceneSpec& spec_;
  NodeNames names_;
  std::vector<const NodeKind*> kinds_;  ///< null: unknown
  std::vector<std::vector<Use>> uses_;
  std::vector<std::vector<std::string_view>> use_keys_;  ///< the parameter behind each use
  std::vector<bool> faulty_;
  std::vector<std::size_t> distance_depth_, offset_depth_;
  Found problems_, warnings_;
  MadeNodes made_;
  std::vector<std::size_t> made_index_;
  std::size_t solid_ = 0;
};

}  // namespace blendwright::detail
