#pragma once
// Distances along all directions from their origin: what ray-linear nodes are compared by.
#include "implicit/scene/node.hpp"

namespace blendwright::detail {

/// The least and the greatest a/b found, and where.
struct RatioScan {
  double min = 0.0, max = 0.0;
  Vec3 min_direction = Vec3::UnitX(), max_direction = Vec3::UnitX();
};

/// a(X)/b(X) over the directions X - origin of two distances that are ray-linear about the same point: 2562
/// quasi-uniform directions with axes and diagonals, the best few of them refined. Where b is 0 the ratio is
/// infinite, and 1 where a is 0, too. A sample: extremes narrower than about 2 degrees may be missed.
[[nodiscard]] RatioScan scan_ratio(const Node& a, const Node& b);

/// Encloses |X - origin| / d(X) over all directions of a ray-linear distance d: the radii of d = 1. Bounds,
/// not a sample: from ranges of d over a subdivided cube around the origin. hi is infinite when the ranges do
/// not show that d > 0.
[[nodiscard]] Range radius_bounds(const Node& d);

}  // namespace blendwright::detail
