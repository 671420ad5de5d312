#include "implicit/scene/made_nodes.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "kernel/base/error.hpp"

namespace blendwright::detail {
namespace {

std::size_t hash_of(const Frame& frame) {
  std::size_t h = 0;
  const auto mix = [&h](double x) { h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001b3ull; };
  for (int i = 0; i < 9; ++i) mix(frame.matrix.data()[i]);
  for (int i = 0; i < 3; ++i) mix(frame.offset[i]);
  return h ^ (h >> 29);
}

/// placement.after(frame) as one placement that can still be undone.
Frame composed(const Frame& placement, const Frame& frame) {
  const Frame both = placement.after(frame);
  const double determinant = both.matrix.determinant();
  if (both.offset.allFinite() && std::isnormal(determinant)) return both;
  throw InputError("", "its placements, taken together, leave the range of numbers");
}

}  // namespace

MadeNodes::~MadeNodes() {
  while (!nodes_.empty())
    nodes_.pop_back();  // users first: each node then dies alone, however long the chain
}

std::size_t MadeNodes::add(Node node, std::vector<std::size_t> children,
                           std::shared_ptr<const Frame> placement) {
  const std::size_t i = nodes_.size();
  auto shared = std::make_shared<Node>(node);
  if (node.emit) shared->emit = [this, i](TapeBuilder& t, const Frame& frame) { return emit(i, t, frame); };
  shared->region = [this, i](double value) { return region(i, value); };
  nodes_.push_back({std::move(node), std::move(shared), std::move(children), std::move(placement)});
  return i;
}

std::uint64_t MadeNodes::Emission::number_of(const Frame& frame) {
  const std::size_t hash = hash_of(frame);
  const auto [first, last] = frame_index.equal_range(hash);
  for (auto at = first; at != last; ++at)
    if (frames[at->second] == frame) return at->second;
  frames.push_back(frame);
  frame_index.emplace(hash, frames.size() - 1);
  return frames.size() - 1;
}

StepIndex MadeNodes::emit(std::size_t i, TapeBuilder& builder, const Frame& frame) {
  if (emission_ && emission_->builder == &builder) {
    const Key key{i, emission_->number_of(frame)};
    const auto known = emission_->steps.find(key);
    return known != emission_->steps.end() ? known->second : emit_all(*emission_, key);
  }
  Emission emission{&builder};
  struct Restore {
    Emission*& place;
    Emission* before;
    ~Restore() { place = before; }
  } const restore{emission_, std::exchange(emission_, &emission)};
  return emit_all(emission, {i, emission.number_of(frame)});
}

StepIndex MadeNodes::emit_all(Emission& emission, Key wanted) {
  std::vector<std::pair<Key, bool>> waiting = {{wanted, false}};
  while (!waiting.empty()) {
    auto& [key, children_wait] = waiting.back();
    if (emission.steps.contains(key)) {
      waiting.pop_back();
      continue;
    }
    const Entry& entry = nodes_[key.node];
    const Frame frame = emission.frames[key.what];
    if (!children_wait) {
      children_wait = true;
      const std::uint64_t inner =
          entry.placement ? emission.number_of(composed(*entry.placement, frame)) : key.what;
      for (auto child = entry.children.rbegin(); child != entry.children.rend(); ++child)
        if (nodes_[*child].own.emit && !emission.steps.contains({*child, inner}))
          waiting.push_back({{*child, inner}, false});
      continue;
    }
    const Key done = key;
    waiting.pop_back();
    const StepIndex step = entry.own.emit(*emission.builder, frame);
    if (entry.member) emission.builder->member({step, entry.own.level, *entry.member});
    emission.steps.emplace(done, step);
    if (emission.steps.size() > most_placed_nodes)
      throw InputError("", "is made of more than " + std::to_string(most_placed_nodes) +
                               " nodes, each counted once for every place it is put to; must be of fewer");
  }
  return emission.steps.at(wanted);
}

std::optional<Box> MadeNodes::region(std::size_t i, double value) {
  const Key key{i, std::bit_cast<std::uint64_t>(value)};
  const auto known = regions_.find(key);
  if (known != regions_.end()) return known->second;
  if (!missing_) return find_regions(key);
  missing_->push_back(key);
  return Box{};  // whoever asked will be asked again when this region is there
}

std::optional<Box> MadeNodes::find_regions(Key wanted) {
  std::vector<Key> missing;
  struct Restore {
    std::vector<Key>*& place;
    ~Restore() { place = nullptr; }
  } const restore{missing_};
  missing_ = &missing;
  std::vector<Key> waiting = {wanted};
  while (!waiting.empty()) {
    if (regions_.size() + waiting.size() > most_regions) return std::nullopt;
    const Key key = waiting.back();
    missing.clear();
    const std::optional<Box> box =
        regions_.contains(key) ? std::nullopt : nodes_[key.node].own.region(std::bit_cast<double>(key.what));
    if (!missing.empty()) {
      waiting.insert(waiting.end(), missing.rbegin(), missing.rend());
      continue;
    }
    waiting.pop_back();
    regions_.emplace(key, box);
  }
  return regions_.at(wanted);
}

}  // namespace blendwright::detail
