#include "implicit/scene/scene_builder.hpp"

#include <algorithm>

#include "kernel/base/number_text.hpp"

namespace blendwright::detail {
namespace {

std::string quoted(std::string_view text) { return '"' + std::string(text) + '"'; }
std::string count_text(std::size_t n) { return std::to_string(n); }

std::string unknown_kind(const std::string& kind) {
  std::vector<std::string> known;
  for (const NodeKind* row : node_kinds()) known.emplace_back(row->name);
  const std::string near = suggestion(kind, known);
  return "is " + quoted(kind) + ", must be a kind of node" +
         (near.empty() ? ", as \"list nodes\" prints them" : near);
}

}  // namespace

SceneBuilder::SceneBuilder(const SceneSpec& spec)
    : spec_(spec),
      names_(spec.nodes),
      kinds_(spec.nodes.size(), nullptr),
      uses_(spec.nodes.size()),
      use_keys_(spec.nodes.size()),
      faulty_(spec.nodes.size(), false),
      distance_depth_(spec.nodes.size(), 0),
      offset_depth_(spec.nodes.size(), 0),
      made_index_(spec.nodes.size(), 0) {
  check_names();
  check_nodes();
  const MakingOrder order = making_order(uses_);
  check_cycles(order);
  for (const std::size_t i : order.order) make(i);
  std::vector<Problem> problems = in_order(std::move(problems_));
  if (spec_.nodes.empty()) problems.push_back({"/nodes", "is empty, must have at least one node"});
  problems_.clear();
  check_solid();
  for (auto& [node, p] : problems_) problems.push_back(std::move(p));
  if (!problems.empty()) throw InputError(std::move(problems));
}

void SceneBuilder::problem(std::size_t node, const std::string& path, std::string message) {
  faulty_[node] = true;
  problems_.push_back(
      {node, {pointer_of(spec_.nodes[node]) + (path.empty() ? "" : "/") + path, std::move(message)}});
}

std::vector<Problem> SceneBuilder::in_order(Found found) {
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Problem> problems;
  problems.reserve(found.size());
  for (auto& [node, p] : found) problems.push_back(std::move(p));
  return problems;
}

void SceneBuilder::check_names() {
  for (std::size_t i = 0; i < spec_.nodes.size(); ++i) {
    const NodeSpec& node = spec_.nodes[i];
    if (node.name.empty()) {
      problem(i, "", "has no name, must have one");
      continue;
    }
    const auto first = static_cast<std::size_t>(names_.find(node.name));
    if (first != i)
      problem(i, "",
              "has the name " + quoted(node.name) + " of the node at " + pointer_of(spec_.nodes[first]) +
                  ", must have one of its own");
  }
}

void SceneBuilder::check_nodes() {
  for (std::size_t i = 0; i < spec_.nodes.size(); ++i) kinds_[i] = find_node_kind(spec_.nodes[i].kind);
  for (std::size_t i = 0; i < spec_.nodes.size(); ++i) {
    if (!kinds_[i]) {
      problem(i, "kind", unknown_kind(spec_.nodes[i].kind));
      continue;
    }
    const ValueCheck check = check_values(spec_.nodes[i], *kinds_[i]);
    for (const Problem& p : check.problems) problem(i, p.where, p.message);
    check_links(i, check.links);
  }
}

void SceneBuilder::check_links(std::size_t node, const std::vector<NodeLink>& links) {
  for (const NodeLink& link : links) {
    const std::ptrdiff_t found = names_.find(link.name);
    if (found < 0) {
      problem(node, link.path, names_.missing(link.name));
      continue;
    }
    const auto other = static_cast<std::size_t>(found);
    uses_[node].push_back({other, link.path});
    use_keys_[node].push_back(link.key);
    if (!kinds_[other]) continue;
    const bool wanted = link.key == profile_key, is = kinds_[other]->family == NodeFamily::profile;
    if (is != wanted)
      problem(
          node, link.path,
          "is " + quoted(link.name) + ", a " + std::string(kinds_[other]->name) + ", must be " +
              (wanted ? "a profile (a plane gauge)" : "a node in space; a profile is for sweeps and bars"));
  }
}

void SceneBuilder::check_cycles(const MakingOrder& order) {
  constexpr std::size_t shown = 12;
  std::vector<bool> ordered(spec_.nodes.size(), false);
  for (const std::size_t i : order.order) ordered[i] = true;
  for (std::size_t i = 0; i < spec_.nodes.size(); ++i)
    if (!ordered[i]) faulty_[i] = true;
  for (const MakingOrder::Cycle& cycle : order.cycles) {
    std::string text;
    for (std::size_t k = 0; k < std::min(shown, cycle.nodes.size()); ++k)
      text += spec_.nodes[cycle.nodes[k]].name + " -> ";
    if (cycle.nodes.size() > shown) text += "... (" + count_text(cycle.nodes.size()) + " nodes) -> ";
    problem(cycle.node, cycle.path,
            "leads back to its own node: " + text + spec_.nodes[cycle.node].name + "; must not be a cycle");
  }
}

bool SceneBuilder::is_placement(std::size_t node) const {
  return kinds_[node]->family == NodeFamily::placement;
}

void SceneBuilder::make(std::size_t node) {
  const NodeKind* kind = kinds_[node];
  std::vector<CheckedInputs::Link> links;
  std::vector<std::size_t> children;
  for (std::size_t k = 0; k < uses_[node].size(); ++k) {
    const std::size_t other = uses_[node][k].node;
    if (faulty_[other]) faulty_[node] = true;
    distance_depth_[node] = std::max(distance_depth_[node], distance_depth_[other]);
    offset_depth_[node] = std::max(offset_depth_[node], offset_depth_[other]);
    if (faulty_[node]) continue;
    links.push_back({use_keys_[node][k], made_.node(made_index_[other])});
    children.push_back(made_index_[other]);
  }
  if (faulty_[node]) return;
  if (kind->family == NodeFamily::distance_operation && ++distance_depth_[node] > most_distance_operations)
    return problem(node, "",
                   "is the " + count_text(distance_depth_[node]) +
                       "th distance operation inside each other, must be at most the " +
                       count_text(most_distance_operations) + "th");
  if (kind->family == NodeFamily::offset && ++offset_depth_[node] > most_offsets)
    return problem(node, "",
                   "is the " + count_text(offset_depth_[node]) +
                       "th offset inside each other, must be at most the " + count_text(most_offsets) + "th");

  CheckedInputs inputs(spec_.nodes[node], *kind, std::move(links), spec_.strict);
  Node made;
  try {
    made = kind->make(inputs);
  } catch (const InputError& e) {
    for (const Problem& p : e.problems()) inputs.problem(p.where, "", p.message, -1);
  }
  for (const Problem& p : inputs.problems()) problem(node, p.where, p.message);
  if (faulty_[node]) return;
  for (const Problem& p : inputs.warnings())
    warnings_.push_back(
        {node, {pointer_of(spec_.nodes[node]) + (p.where.empty() ? "" : "/") + p.where, p.message}});
  auto placement = is_placement(node) ? std::static_pointer_cast<const Frame>(made.detail) : nullptr;
  made_index_[node] = made_.add(std::move(made), std::move(children), std::move(placement));
}

void SceneBuilder::check_solid() {
  const std::ptrdiff_t found = names_.find(spec_.solid);
  if (found < 0) {
    problems_.push_back({0, {"/solid", names_.missing(spec_.solid)}});
    return;
  }
  solid_ = static_cast<std::size_t>(found);
  if (!faulty_[solid_] && !made_.node(made_index_[solid_])->emit)
    problems_.push_back({0,
                         {"/solid", "is " + quoted(spec_.solid) + ", a " + std::string(kinds_[solid_]->name) +
                                        ", must be a node in space"}});
}

std::optional<Box> SceneBuilder::bounds() {
  const std::optional<Box> box = made_.region(made_index_[solid_], surface_value(solid().level));
  return box && box->finite() ? box : std::nullopt;
}

std::vector<std::string> SceneBuilder::mark_members() {
  std::vector<std::string> members;
  std::vector<bool> seen(spec_.nodes.size(), false);
  std::vector<std::size_t> waiting = {solid_};
  while (!waiting.empty()) {
    const std::size_t i = waiting.back();
    waiting.pop_back();
    if (seen[i]) continue;
    seen[i] = true;
    const NodeFamily family = kinds_[i]->family;
    if (family == NodeFamily::distance || family == NodeFamily::distance_operation ||
        family == NodeFamily::field || family == NodeFamily::solid || family == NodeFamily::offset) {
      made_.set_member(made_index_[i], static_cast<std::uint32_t>(members.size()));
      members.push_back(spec_.nodes[i].name);
      continue;
    }
    for (auto use = uses_[i].rbegin(); use != uses_[i].rend(); ++use) waiting.push_back(use->node);
  }
  return members;
}

std::shared_ptr<const Tape> SceneBuilder::tape() {
  try {
    TapeBuilder builder;
    const StepIndex result = made_.emit(made_index_[solid_], builder, Frame());
    std::shared_ptr<const Tape> tape = builder.finish(result);
    if (tape->size() > most_steps)
      throw InputError("", "takes " + count_text(tape->size()) + " steps to compute, must take at most " +
                               count_text(most_steps));
    return tape;
  } catch (const InputError& e) {
    throw e.under(pointer_of(spec_.nodes[solid_]));
  }
}

}  // namespace blendwright::detail
