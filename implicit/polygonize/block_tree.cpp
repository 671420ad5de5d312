#include "implicit/polygonize/block_tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "implicit/polygonize/batches.hpp"
#include "implicit/polygonize/memory_need.hpp"

namespace blendwright::detail {
namespace {

using ModelPtr = std::shared_ptr<const ScalarField::Model>;

/// A cube of 2^shift blocks, where shift is that of its level; its blocks outside of the grid do not exist.
struct Node {
  GridIndex at{};  ///< in units of its own size
  ModelPtr model;  ///< valid in the node's box grown by half a cell, or in a larger one
  bool inside = false;
};

/// The children of a node that are kept, in Morton order.
struct Children {
  std::array<Node, 8> list;
  std::size_t size = 0;
  bool inside_at_side = false;
};

enum class Side { outside, inside, both };

Side side_of(Level level, Range range) {
  const double a = inside(level, range.lo), b = inside(level, range.hi);
  if (std::max(a, b) <= 0.0) return Side::outside;
  return std::min(a, b) > 0.0 ? Side::inside : Side::both;
}

class Descent {
 public:
  Descent(const ScalarField& field, const CellGrid& grid, bool keep_inside_at_side)
      : field_(field), grid_(grid), keep_inside_at_side_(keep_inside_at_side) {
    std::uint32_t most = 1;
    for (int a = 0; a < 3; ++a) most = std::max(most, grid.blocks(a));
    levels_ = std::bit_width(most - 1);
  }
  [[nodiscard]] int levels() const { return levels_; }

  /// The whole grid as one node; none when the surface cannot meet it.
  [[nodiscard]] Children root() const {
    Children out;
    add({}, levels_, field_.shared_model(), false, out);
    return out;
  }
  /// `shift`: that of the children.
  [[nodiscard]] Children children(const Node& node, int shift) const {
    Children out;
    for (std::uint32_t c = 0; c < 8; ++c)
      add({2 * node.at[0] + (c & 1u), 2 * node.at[1] + (c >> 1 & 1u), 2 * node.at[2] + (c >> 2)}, shift,
          node.model, node.inside, out);
    return out;
  }

 private:
  void add(const GridIndex& at, int shift, const ModelPtr& model, bool known_inside, Children& out) const {
    GridIndex from{}, to{};
    bool at_side = false;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::uint32_t blocks = grid_.blocks(static_cast<int>(a));
      from[a] = at[a] << shift;
      if (from[a] >= blocks) return;
      to[a] = std::min((at[a] + 1) << shift, blocks);
      at_side = at_side || from[a] == 0 || to[a] == blocks;
    }
    if (!known_inside) {
      const Box box = grid_.box_of_blocks(from, to);
      const Side side = side_of(field_.level(), model->range(box));
      if (side == Side::outside) return;
      if (side == Side::both) {
        ModelPtr shorter = model->within(grid_.grown(box)).model;
        out.list[out.size++] = {at, shorter ? std::move(shorter) : model, false};
        return;
      }
    }
    if (!at_side) return;
    out.inside_at_side = true;
    if (keep_inside_at_side_) out.list[out.size++] = {at, model, true};
  }

  const ScalarField& field_;
  const CellGrid& grid_;
  bool keep_inside_at_side_;
  int levels_ = 0;
};

/// splitmix64
std::uint64_t next_random(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

/// Expected number of blocks below `nodes`, without making them: random paths to the bottom, each weighted
/// with the product of the numbers of children on its way (Knuth 1975, estimating the size of a tree).
double estimated_blocks(const Descent& descent, const std::vector<Node>& nodes, int shift) {
  constexpr int paths = 256;
  std::uint64_t state = 1;
  double sum = 0.0;
  for (int path = 0; path < paths; ++path) {
    Node node = nodes[next_random(state) % nodes.size()];
    double weight = static_cast<double>(nodes.size());
    for (int s = shift - 1; s >= 0 && weight > 0.0; --s) {
      const Children children = descent.children(node, s);
      weight *= static_cast<double>(children.size);
      if (children.size > 0) node = children.list[next_random(state) % children.size];
    }
    sum += weight;
  }
  return sum / paths;
}

/// One level of the descent; the order of the result depends on the nodes only.
std::vector<Node> next_level(const Descent& descent, const std::vector<Node>& nodes, int shift,
                             bool& inside_at_side, const Progress& progress) {
  std::vector<Children> children(nodes.size());
  const double levels = descent.levels(), done = levels - 1.0 - shift;
  for_each_in_batches(nodes.size(), progress, 0.1 * done / levels, 0.1 * (done + 1.0) / levels,
                      "finding blocks",
                      [&](std::size_t n) { children[n] = descent.children(nodes[n], shift); });
  std::size_t count = 0;
  for (const Children& c : children) count += c.size;
  std::vector<Node> next;
  next.reserve(count);
  for (Children& c : children) {
    inside_at_side = inside_at_side || c.inside_at_side;
    std::move(c.list.begin(), c.list.begin() + static_cast<std::ptrdiff_t>(c.size), std::back_inserter(next));
  }
  return next;
}

/// Refuses early what cannot fit. Every node left may have 4^shift blocks with surface below it; only where
/// that would be too much is the true number estimated, and the estimate is trusted to a factor of two.
void require_room(const Descent& descent, const std::vector<Node>& nodes, int shift, std::size_t max_memory,
                  double cell) {
  const auto count = static_cast<double>(nodes.size());
  require_memory(count * bytes_per_block, max_memory, cell);
  const auto limit = static_cast<double>(max_memory);
  if (shift == 0 || nodes.empty() || bytes_for_blocks(std::ldexp(count, 2 * shift)) <= limit) return;
  const double bytes = bytes_for_blocks(estimated_blocks(descent, nodes, shift));
  if (bytes > 2.0 * limit) require_memory(bytes, max_memory, cell);
}

/// Bits of x at every third place.
std::uint64_t spread(std::uint64_t x) {
  std::uint64_t result = 0;
  for (unsigned bit = 0; bit < 21; ++bit) result |= (x >> bit & 1u) << (3 * bit);
  return result;
}
std::uint64_t key(const GridIndex& at) { return spread(at[0]) | spread(at[1]) << 1 | spread(at[2]) << 2; }

}  // namespace

std::optional<std::size_t> LiveBlocks::find(const GridIndex& at) const {
  const std::uint64_t wanted = key(at);
  const auto found = std::lower_bound(keys.begin(), keys.end(), wanted);
  if (found == keys.end() || *found != wanted) return std::nullopt;
  return static_cast<std::size_t>(found - keys.begin());
}

LiveBlocks find_live_blocks(const ScalarField& field, const CellGrid& grid, bool keep_inside_at_side,
                            std::size_t max_memory, const Progress& progress) {
  const Descent descent(field, grid, keep_inside_at_side);
  LiveBlocks result;
  Children root = descent.root();
  result.inside_at_side = root.inside_at_side;
  std::vector<Node> nodes(root.list.begin(), root.list.begin() + static_cast<std::ptrdiff_t>(root.size));
  for (int shift = descent.levels(); shift > 0; --shift) {
    require_room(descent, nodes, shift, max_memory, grid.cell());
    nodes = next_level(descent, nodes, shift - 1, result.inside_at_side, progress);
  }
  require_memory(static_cast<double>(nodes.size()) * bytes_per_block, max_memory, grid.cell());
  result.blocks.reserve(nodes.size());
  result.keys.reserve(nodes.size());
  for (Node& node : nodes) {
    result.keys.push_back(key(node.at));
    result.crossed += node.inside ? 0 : 1;
    result.blocks.push_back({node.at, std::move(node.model), node.inside});
  }
  return result;
}

}  // namespace blendwright::detail
