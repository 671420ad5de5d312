#pragma once
// A primary covered by small balls: what can be said of its distance from a place without a foot. Private to
// this module.
#include <vector>

#include "parametric/rolling_ball/ball_primary.hpp"

namespace blendwright {

/// Every point of the primary that is in the covered box is in one of the cells.
struct CoverCell {
  Vec3 centre;
  double radius = 0.0;
  std::optional<Vec3> point{};  ///< of the primary, in or near the cell
  UV at{};                      ///< of a surface
};

/// Cells of radius <= size, or larger ones where there would be more than 60 000. Of a field no point is left
/// out; a surface is covered by samples, with a margin.
[[nodiscard]] std::vector<CoverCell> cover(const BallPrimary& primary, const Box& box, double size);

}  // namespace blendwright
