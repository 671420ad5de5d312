#include "implicit/polygonize/cell_grid.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::detail {
namespace {

constexpr char axis_name[] = "xyz";

void require_few_cells(int axis, double cells, double length, double cell) {
  if (cells <= static_cast<double>(max_cells_per_axis)) return;
  const double least = length / static_cast<double>(max_cells_per_axis);
  throw InputError("cell", "is " + number_text(cell) + ", which cuts the box into " + number_text(cells, 3) +
                               " cells along " + axis_name[axis] + "; at most " +
                               number_text(max_cells_per_axis) + " are possible: a cell of " +
                               number_text(1.01 * least, 3) + " is enough");
}

}  // namespace

CellGrid CellGrid::around(const Box& bounds, double cell) {
  Box box;
  GridIndex cells{};
  for (int a = 0; a < 3; ++a) {
    const double first = std::floor(bounds.lo[a] / cell) - 1.0, last = std::ceil(bounds.hi[a] / cell) + 1.0;
    require_few_cells(a, last - first, (last - first) * cell, cell);
    box.lo[a] = first * cell;
    box.hi[a] = last * cell;
    cells[static_cast<std::size_t>(a)] = static_cast<std::uint32_t>(last - first);
  }
  return {box, cells};
}

CellGrid CellGrid::in(const Box& box, double cell) {
  GridIndex cells{};
  for (int a = 0; a < 3; ++a) {
    const double length = box.hi[a] - box.lo[a];
    if (!box.finite() || !(length > 0.0))
      throw InputError("box", std::string("goes from ") + number_text(box.lo[a]) + " to " +
                                  number_text(box.hi[a]) + " along " + axis_name[a] +
                                  "; it must be finite and have a volume");
    const double count = std::max(1.0, std::ceil(length / cell * (1.0 - 1e-12)));  // rounding of the quotient
    require_few_cells(a, count, length, cell);
    cells[static_cast<std::size_t>(a)] = static_cast<std::uint32_t>(count);
  }
  return {box, cells};
}

CellGrid::CellGrid(const Box& box, const GridIndex& cells) : box_(box), cells_(cells) {
  for (int a = 0; a < 3; ++a) {
    std::vector<double>& at = at_[static_cast<std::size_t>(a)];
    const std::uint32_t n = this->cells(a);
    at.resize(n + 1);
    for (std::uint32_t i = 0; i <= n; ++i) at[i] = (box.lo[a] * (n - i) + box.hi[a] * i) / n;
    at.front() = box.lo[a];
    at.back() = box.hi[a];
    cell_ = std::max(cell_, (box.hi[a] - box.lo[a]) / n);
    if (!std::is_sorted(at.begin(), at.end(), std::less_equal<>{}))
      throw InputError("cell", "is too small next to the coordinates of the box (" + number_text(box.lo[a]) +
                                   " to " + number_text(box.hi[a]) + " along " + axis_name[a] +
                                   "): neighbouring grid points are the same number");
  }
}

Box CellGrid::box_of_blocks(const GridIndex& from, const GridIndex& to) const {
  Box box;
  for (int a = 0; a < 3; ++a) {
    const auto k = static_cast<std::size_t>(a);
    box.lo[a] = at(a, std::min(from[k] * block_cells, cells(a)));
    box.hi[a] = at(a, std::min(to[k] * block_cells, cells(a)));
  }
  return box;
}

Box CellGrid::grown(const Box& box) const {
  const Vec3 half = Vec3::Constant(0.5 * cell_);
  return {(box.lo - half).cwiseMax(box_.lo), (box.hi + half).cwiseMin(box_.hi)};
}

BlockPlace::BlockPlace(const CellGrid& grid, const GridIndex& block) {
  for (std::size_t a = 0; a < 3; ++a) {
    const int axis = static_cast<int>(a);
    first[a] = block[a] * block_cells;
    at_low_side[a] = block[a] == 0;
    at_high_side[a] = block[a] + 1 == grid.blocks(axis);
    cells[a] = static_cast<int>(std::min(block_cells, grid.cells(axis) - first[a]));
    owned[a] = at_high_side[a] ? cells[a] + 1 : static_cast<int>(block_cells);
  }
}

bool BlockPlace::at_side() const {
  return at_low_side[0] || at_low_side[1] || at_low_side[2] || at_high_side[0] || at_high_side[1] ||
         at_high_side[2];
}

}  // namespace blendwright::detail
