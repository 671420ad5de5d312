#pragma once
// The grid that a mesh is taken from: cells of (nearly) the asked edge that fit a box exactly, gathered in
// blocks of 8^3 cells.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/field/range.hpp"

namespace blendwright::detail {

inline constexpr std::uint32_t block_cells = 8;  ///< cells of a block along an axis
/// Blocks of an axis are numbered with 17 bits, so that three fit one 64-bit key.
inline constexpr std::uint32_t max_cells_per_axis = block_cells << 17;

using GridIndex = std::array<std::uint32_t, 3>;

/// Cells and grid points of a box. Grid point i of axis a stands at (lo (n - i) + hi i) / n: the sides of the
/// box are met exactly, and a box symmetric about 0 has symmetric grid points.
class CellGrid {
 public:
  /// The smallest box of multiples of `cell` that holds `bounds` with a margin of one cell.
  [[nodiscard]] static CellGrid around(const Box& bounds, double cell);
  /// `box` itself, cut into the fewest cells with edges of at most `cell`. Throws InputError ("box", "cell").
  [[nodiscard]] static CellGrid in(const Box& box, double cell);

  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] std::uint32_t cells(int axis) const { return cells_[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] std::uint32_t blocks(int axis) const { return (cells(axis) + block_cells - 1) / block_cells; }
  [[nodiscard]] double at(int axis, std::uint32_t i) const { return at_[static_cast<std::size_t>(axis)][i]; }
  /// All grid points of an axis.
  [[nodiscard]] std::span<const double> axis(int a) const { return at_[static_cast<std::size_t>(a)]; }
  /// The longest edge of a cell; edges of different axes differ only where a given box is no multiple of it.
  [[nodiscard]] double cell() const { return cell_; }
  /// The box of the blocks [from, to) in block numbers, cut at the grid's own box.
  [[nodiscard]] Box box_of_blocks(const GridIndex& from, const GridIndex& to) const;
  /// `box` grown by half a cell on every side, cut at the grid's own box.
  [[nodiscard]] Box grown(const Box& box) const;

 private:
  CellGrid(const Box& box, const GridIndex& cells);
  Box box_;
  GridIndex cells_;
  double cell_ = 0.0;
  std::array<std::vector<double>, 3> at_;
};

/// A block's place in the grid. Corners of the block have local indices 0..cells. A grid point (and the grid
/// edges that start there) belongs to the block in which its local indices are below `owned`: 8, but one more
/// than its cells for the last block of an axis, beyond which there is no other.
struct BlockPlace {
  GridIndex first{};  ///< grid index of the lowest corner
  std::array<int, 3> cells{}, owned{};
  std::array<bool, 3> at_low_side{}, at_high_side{};  ///< the block touches that side of the grid's box

  BlockPlace() = default;
  BlockPlace(const CellGrid& grid, const GridIndex& block);
  [[nodiscard]] bool at_side() const;
  /// Number of a corner among all corners of the block, x fastest.
  [[nodiscard]] std::size_t corner(int i, int j, int k) const {
    return static_cast<std::size_t>(i + (cells[0] + 1) * (j + (cells[1] + 1) * k));
  }
  [[nodiscard]] std::size_t corners() const { return corner(cells[0], cells[1], cells[2]) + 1; }
};

}  // namespace blendwright::detail
