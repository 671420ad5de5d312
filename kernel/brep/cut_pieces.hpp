#pragma once
// Private: cuts of a parameter rectangle, split at its seams.
#include "kernel/brep/trim_region.hpp"

namespace blendwright::detail {

[[nodiscard]] std::vector<CutPiece> cut_pieces(const RegionBox& box, const std::vector<RegionCut>& cuts);

}  // namespace blendwright::detail
