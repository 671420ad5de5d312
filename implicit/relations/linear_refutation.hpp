#pragma once
// Private: whether linear bounds can all be >= 0 at one point of a box.
#include <span>

#include "kernel/field/linear_bound.hpp"

namespace blendwright::detail {

struct LinearPoint {
  /// Proven: sum mu_i f_i <= upper all over the box for some mu_i >= 0, not all 0. upper < 0: no point of the
  /// box has all f_i >= 0.
  double upper;
  /// About where min_i f_i is largest, t in [-1, 1]^3, and how large that can be there, each f_i divided by
  /// about its own gradient (model units).
  Vec3 t;
  double height;
};

/// The linear programme  min over mu of max over t of sum mu_i (value_i + slope_i.t + rest_i.hi)  in its dual
/// form, by the simplex method (Dantzig 1963): with the magnitude of the combined slope split in p - q,
///   min sum mu_i c_i + sum_j (p_j + q_j),  sum mu_i = 1,  sum mu_i slope_i - p + q = 0,  all >= 0.
/// Every step of it is a valid combination, so it may stop anywhere; the result is rounded outward once.
/// Bounds that are not finite are left out. Vyatkin's convex combination of two fields is the case of two
/// bounds. `length` of the box: what `height` is measured in.
[[nodiscard]] LinearPoint highest_point(std::span<const LinearBound> bounds, double length);

}  // namespace blendwright::detail
