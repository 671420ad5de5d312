#pragma once
// Who uses whom in a scene: names, references, the order in which nodes can be made, cycles.
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "implicit/scene/node_values.hpp"

namespace blendwright::detail {

/// The nodes of a scene by name; a name that appears again still means the first node.
class NodeNames {
 public:
  explicit NodeNames(const std::vector<NodeSpec>& nodes);
  /// -1: there is none.
  [[nodiscard]] std::ptrdiff_t find(std::string_view name) const;
  /// "is "x", must be the name of a node; did you mean "y"?". Looks for a near name for the first few only:
  /// that takes time.
  [[nodiscard]] std::string missing(std::string_view name);

 private:
  std::unordered_map<std::string_view, std::size_t> index_;
  std::vector<std::string> names_;
  int suggestions_left_ = 20;
};

/// What a node uses, and through which of its values.
struct Use {
  std::size_t node;
  std::string path;
};

struct MakingOrder {
  std::vector<std::size_t> order;  ///< everything that does not depend on a cycle; used nodes before users
  struct Cycle {
    std::size_t node;                ///< the first of the cycle in the order of the scene
    std::string path;                ///< through which it uses the next
    std::vector<std::size_t> nodes;  ///< from there on, each uses the next and the last the first
  };
  std::vector<Cycle> cycles;  ///< at least one for every group of nodes that depend on each other
};
[[nodiscard]] MakingOrder making_order(const std::vector<std::vector<Use>>& uses);

}  // namespace blendwright::detail
