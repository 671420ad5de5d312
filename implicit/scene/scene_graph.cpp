#include "implicit/scene/scene_graph.hpp"

#include <algorithm>

namespace blendwright::detail {

NodeNames::NodeNames(const std::vector<NodeSpec>& nodes) {
  index_.reserve(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) index_.emplace(nodes[i].name, i);
  for (const NodeSpec& node : nodes)
    if (!node.name.empty() && node.name.front() != '/') names_.push_back(node.name);
}

std::ptrdiff_t NodeNames::find(std::string_view name) const {
  const auto at = index_.find(name);
  return at == index_.end() ? -1 : static_cast<std::ptrdiff_t>(at->second);
}

std::string NodeNames::missing(std::string_view name) {
  const std::string text = "is \"" + std::string(name) + "\", must be the name of a node";
  if (suggestions_left_ == 0) return text;
  --suggestions_left_;
  return text + suggestion(name, names_);
}

namespace {

/// Cycles among the nodes that are `left`, all of which use at least one that is left: walks along the first
/// such use until the walk meets itself.
std::vector<MakingOrder::Cycle> find_cycles(const std::vector<std::vector<Use>>& uses,
                                            const std::vector<bool>& left) {
  std::vector<MakingOrder::Cycle> cycles;
  enum class State : char { fresh, on_walk, done };
  std::vector<State> state(uses.size(), State::fresh);
  std::vector<const Use*> next(uses.size(), nullptr);
  for (std::size_t start = 0; start < uses.size(); ++start) {
    if (!left[start] || state[start] != State::fresh) continue;
    std::vector<std::size_t> walk;
    std::size_t at = start;
    while (state[at] == State::fresh) {
      state[at] = State::on_walk;
      walk.push_back(at);
      const auto use =
          std::find_if(uses[at].begin(), uses[at].end(), [&](const Use& u) { return left[u.node]; });
      next[at] = &*use;
      at = use->node;
    }
    if (state[at] == State::on_walk) {
      std::vector<std::size_t> cycle(std::find(walk.begin(), walk.end(), at), walk.end());
      std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
      cycles.push_back({cycle.front(), next[cycle.front()]->path, cycle});
    }
    for (const std::size_t i : walk) state[i] = State::done;
  }
  return cycles;
}

}  // namespace

MakingOrder making_order(const std::vector<std::vector<Use>>& uses) {
  std::vector<std::vector<std::size_t>> users(uses.size());
  std::vector<std::size_t> waits_for(uses.size());
  for (std::size_t i = 0; i < uses.size(); ++i) {
    waits_for[i] = uses[i].size();
    for (const Use& use : uses[i]) users[use.node].push_back(i);
  }
  MakingOrder result;
  result.order.reserve(uses.size());
  for (std::size_t i = 0; i < uses.size(); ++i)
    if (waits_for[i] == 0) result.order.push_back(i);
  for (std::size_t k = 0; k < result.order.size(); ++k)
    for (const std::size_t user : users[result.order[k]])
      if (--waits_for[user] == 0) result.order.push_back(user);
  if (result.order.size() == uses.size()) return result;

  std::vector<bool> left(uses.size(), true);
  for (const std::size_t i : result.order) left[i] = false;
  result.cycles = find_cycles(uses, left);
  return result;
}

}  // namespace blendwright::detail
