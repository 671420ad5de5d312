#pragma once
// What a block knows of the surface: which of its corners are inside, and so which of its grid edges carry a
// vertex. Vertices have numbers by rank, so that a neighbour finds the number of a shared vertex without any
// table of edges.
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "implicit/polygonize/cell_grid.hpp"

namespace blendwright::detail {

/// The grid edge from corner (i, j, k) of a block to the next corner along `axis`.
struct GridEdge {
  int axis = 0, i = 0, j = 0, k = 0;
};

class BlockSurface {
 public:
  BlockSurface() = default;  ///< of no cells
  /// `inside`: the value of inside() at every corner of the place, in the order of BlockPlace::corner. With
  /// `cap`, the inside corners in the box's sides carry vertices too.
  BlockSurface(const BlockPlace& place, std::span<const double> inside, bool cap);
  /// All corners are inside.
  static BlockSurface full(const BlockPlace& place, bool cap);

  /// Bit i: corner (i, j, k) is inside.
  [[nodiscard]] unsigned row(int j, int k) const { return rows_[slot(j, k)]; }
  /// An own corner in a side of the grid's box is inside.
  [[nodiscard]] bool reaches_side() const { return reaches_side_; }
  /// How many own edges are crossed; their vertices have the first numbers.
  [[nodiscard]] std::uint32_t edge_vertices() const { return edge_vertices_; }
  [[nodiscard]] std::uint32_t vertices() const {
    return edge_vertices_ + static_cast<std::uint32_t>(cap_corners_.size());
  }
  /// Number of the vertex on an edge that the block owns and the surface crosses.
  [[nodiscard]] std::uint32_t vertex(const GridEdge& e) const {
    const unsigned before = crossings(e.axis, e.j, e.k) & ((1u << e.i) - 1u);
    return first_[static_cast<std::size_t>(e.axis)][slot(e.j, e.k)] + bits[before];
  }
  /// Number of the vertex at an inside corner in the box's sides that the block owns.
  [[nodiscard]] std::uint32_t cap_vertex(int i, int j, int k) const;
  /// The own corners that carry vertices of the cap, in the order of their numbers.
  [[nodiscard]] std::vector<std::array<int, 3>> cap_corners() const;

  /// body(const GridEdge&) for the block's own crossed edges in the order of their numbers.
  template <class Body>
  void for_each_edge(Body body) const {
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k < 9; ++k)
        for (int j = 0; j < 9; ++j)
          for (unsigned m = crossings(axis, j, k); m != 0; m &= m - 1)
            body(GridEdge{axis, std::countr_zero(m), j, k});
  }
  /// body(i, j, k, inside corners) for the cells that the surface crosses.
  template <class Body>
  void for_each_cell(Body body) const {
    for (int k = 0; k < cells_[2]; ++k)
      for (int j = 0; j < cells_[1]; ++j) {
        const unsigned a = row(j, k), b = row(j + 1, k), c = row(j, k + 1), d = row(j + 1, k + 1);
        if ((a | b | c | d) == 0) continue;
        for (int i = 0; i < cells_[0]; ++i) {
          const unsigned inside =
              (a >> i & 3u) | (b >> i & 3u) << 2 | (c >> i & 3u) << 4 | (d >> i & 3u) << 6;
          if (inside != 0 && inside != 255u) body(i, j, k, inside);
        }
      }
  }

 private:
  BlockSurface(const BlockPlace& place, bool cap);
  void number_vertices(const BlockPlace& place, bool cap);
  [[nodiscard]] static std::size_t slot(int j, int k) { return static_cast<std::size_t>(j + 9 * k); }
  /// Bit i: the own edge (axis, i, j, k) is crossed.
  [[nodiscard]] unsigned crossings(int axis, int j, int k) const {
    const unsigned here = row(j, k);
    const auto [x, y, z] = owned_;
    const auto [nx, ny, nz] = cells_;
    if (axis == 0) return j < y && k < z ? (here ^ here >> 1) & ((1u << nx) - 1u) : 0u;
    if (axis == 1) return j < ny && k < z ? (here ^ row(j + 1, k)) & ((1u << x) - 1u) : 0u;
    return j < y && k < nz ? (here ^ row(j, k + 1)) & ((1u << x) - 1u) : 0u;
  }
  /// Number of one bits.
  static constexpr std::array<std::uint8_t, 512> bits = [] {
    std::array<std::uint8_t, 512> count{};
    for (unsigned m = 0; m < 512; ++m) count[m] = static_cast<std::uint8_t>(std::popcount(m));
    return count;
  }();

  std::array<std::uint16_t, 81> rows_{};
  std::array<std::array<std::uint16_t, 81>, 3> first_{};
  std::uint32_t edge_vertices_ = 0;
  std::array<int, 3> cells_{}, owned_{};
  bool reaches_side_ = false;
  std::vector<std::uint16_t> cap_corners_;  ///< i + 9 (j + 9 k), sorted
};

}  // namespace blendwright::detail
