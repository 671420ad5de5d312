#pragma once
// The nodes of a scene after make(), in an order in which users come after what they use. Nodes ask each
// other for steps and regions; here the answers are kept and computed from the leaves up, so that a node that
// is used in many places is asked once and a chain of any length needs no deep recursion.
#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "implicit/scene/node.hpp"

namespace blendwright::detail {

/// A scene whose field would take more steps is refused, and one with more nodes when each is counted once
/// for every place it is put to.
inline constexpr std::size_t most_steps = 4'000'000, most_placed_nodes = 1'000'000;
/// A region that depends on more regions counts as unknown.
inline constexpr std::size_t most_regions = 1'000'000;

class MadeNodes {
 public:
  MadeNodes() = default;
  ~MadeNodes();
  MadeNodes(const MadeNodes&) = delete;
  MadeNodes& operator=(const MadeNodes&) = delete;

  /// Takes a node whose children were added before and returns its index; `placement`: its children live in
  /// the coordinates that this frame leads to.
  std::size_t add(Node node, std::vector<std::size_t> children, std::shared_ptr<const Frame> placement);
  /// The node as others may use it, while this object lives.
  [[nodiscard]] const std::shared_ptr<const Node>& node(std::size_t i) const { return nodes_[i].shared; }

  /// Steps of this node are members of the tape from now on.
  void set_member(std::size_t i, std::uint32_t member) { nodes_[i].member = member; }

  /// Throws InputError ("") when there are too many steps or placements leave the range of numbers.
  StepIndex emit(std::size_t i, TapeBuilder& builder, const Frame& frame);
  [[nodiscard]] std::optional<Box> region(std::size_t i, double value);

 private:
  struct Entry {
    Node own;                            ///< as made
    std::shared_ptr<const Node> shared;  ///< the same, but asks through this object
    std::vector<std::size_t> children;
    std::shared_ptr<const Frame> placement;
    std::optional<std::uint32_t> member{};
  };
  struct Key {
    std::size_t node;
    std::uint64_t what;  ///< which frame, or the bits of which value
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& k) const {
      return (k.node * 0x9e3779b97f4a7c15ull) ^ (k.what * 0xd6e8feb86659fd93ull >> 7);
    }
  };
  /// What is known of one tape while its steps are being made.
  struct Emission {
    TapeBuilder* builder;
    std::vector<Frame> frames{};
    std::unordered_multimap<std::size_t, std::uint64_t> frame_index{};
    std::unordered_map<Key, StepIndex, KeyHash> steps{};
    [[nodiscard]] std::uint64_t number_of(const Frame& frame);
  };

  StepIndex emit_all(Emission& emission, Key wanted);
  [[nodiscard]] std::optional<Box> find_regions(Key wanted);

  std::vector<Entry> nodes_;
  Emission* emission_ = nullptr;
  std::unordered_map<Key, std::optional<Box>, KeyHash> regions_;
  std::vector<Key>* missing_ = nullptr;  ///< while regions are being found: those asked for and not there yet
};

}  // namespace blendwright::detail
