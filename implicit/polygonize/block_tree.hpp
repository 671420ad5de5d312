#pragma once
// Which blocks the surface can meet: descent from the whole box by the field's ranges.
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "implicit/polygonize/cell_grid.hpp"
#include "kernel/base/progress.hpp"
#include "kernel/field/scalar_field.hpp"

namespace blendwright::detail {

/// A block that is kept. `model` gives the field's values in the block's box grown by half a cell.
struct LiveBlock {
  GridIndex at{};
  std::shared_ptr<const ScalarField::Model> model;
  bool inside = false;  ///< all of it is inside (kept for the cap only)
};

/// The kept blocks in Morton order (x fastest), which is also the order of their keys.
struct LiveBlocks {
  std::vector<LiveBlock> blocks;
  std::vector<std::uint64_t> keys;
  bool inside_at_side = false;  ///< some block that is inside throughout touches a side of the box
  std::size_t crossed = 0;      ///< blocks that are not inside throughout
  [[nodiscard]] std::optional<std::size_t> find(const GridIndex& at) const;
};

/// A corner is inside when inside() > 0 and outside otherwise. A closed box of corners is dropped when its
/// range shows that all are on the same side: inside() <= 0 at the range's outer end, or > 0 at its inner end
/// (inside() is monotone in the value, also in rounded arithmetic). So a grid edge with ends on both sides
/// makes every closed block that it lies in live: no sign change is lost, and the owner of a crossed edge is
/// always there. Blocks that are inside throughout are kept where they touch a side of the box, if
/// `keep_inside_at_side`.
/// Throws InputError("max_memory") when blocks and their share of the mesh cannot be held in `max_memory`.
[[nodiscard]] LiveBlocks find_live_blocks(const ScalarField& field, const CellGrid& grid,
                                          bool keep_inside_at_side, std::size_t max_memory,
                                          const Progress& progress);

}  // namespace blendwright::detail
