#include "implicit/polygonize/block_surface.hpp"

#include <algorithm>

namespace blendwright::detail {

BlockSurface::BlockSurface(const BlockPlace& place, std::span<const double> inside, bool cap)
    : cells_(place.cells), owned_(place.owned) {
  std::size_t corner = 0;
  for (int k = 0; k <= cells_[2]; ++k)
    for (int j = 0; j <= cells_[1]; ++j) {
      unsigned row = 0;
      for (int i = 0; i <= cells_[0]; ++i) row |= static_cast<unsigned>(inside[corner++] > 0.0) << i;
      rows_[slot(j, k)] = static_cast<std::uint16_t>(row);
    }
  number_vertices(place, cap);
}

BlockSurface::BlockSurface(const BlockPlace& place, bool cap) : cells_(place.cells), owned_(place.owned) {
  rows_.fill(0x1ff);
  number_vertices(place, cap);
}
BlockSurface BlockSurface::full(const BlockPlace& place, bool cap) { return {place, cap}; }

void BlockSurface::number_vertices(const BlockPlace& place, bool cap) {
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 9; ++k)
      for (int j = 0; j < 9; ++j) {
        first_[static_cast<std::size_t>(axis)][slot(j, k)] = static_cast<std::uint16_t>(edge_vertices_);
        edge_vertices_ += bits[crossings(axis, j, k)];
      }
  if (!place.at_side()) return;
  const auto on_side = [&](std::size_t axis, int i) {
    return (place.at_low_side[axis] && i == 0) || (place.at_high_side[axis] && i == place.cells[axis]);
  };
  for (int k = 0; k < owned_[2]; ++k)
    for (int j = 0; j < owned_[1]; ++j)
      for (int i = 0; i < owned_[0]; ++i)
        if ((row(j, k) >> i & 1u) != 0 && (on_side(0, i) || on_side(1, j) || on_side(2, k))) {
          reaches_side_ = true;
          if (cap) cap_corners_.push_back(static_cast<std::uint16_t>(i + 9 * (j + 9 * k)));
        }
}

std::uint32_t BlockSurface::cap_vertex(int i, int j, int k) const {
  const auto id = static_cast<std::uint16_t>(i + 9 * (j + 9 * k));
  const auto found = std::lower_bound(cap_corners_.begin(), cap_corners_.end(), id);
  return edge_vertices_ + static_cast<std::uint32_t>(found - cap_corners_.begin());
}

std::vector<std::array<int, 3>> BlockSurface::cap_corners() const {
  std::vector<std::array<int, 3>> corners;
  corners.reserve(cap_corners_.size());
  for (const int id : cap_corners_) corners.push_back({id % 9, id / 9 % 9, id / 81});
  return corners;
}

}  // namespace blendwright::detail
