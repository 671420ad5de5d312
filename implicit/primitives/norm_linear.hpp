#pragma once
// Linear bounds of norms of coordinates.
#include "implicit/eval/linear_shapes.hpp"

namespace blendwright::detail {

/// Whether no coordinate of the box is 0, or next to nothing.
[[nodiscard]] bool in_one_octant(const LinearInput& in);
/// Of a distance that is ray-linear about the origin and convex, with partials of at most `steepness`; or
/// else concave in each octant, where it rises with every magnitude: everything() when the box is not in one.
[[nodiscard]] LinearBound norm_bound(const Op& op, const void* body, const LinearInput& in, bool convex,
                                     const Vec3& steepness);

/// (a^n + b^n)^(1/n) of a, b >= 0: convex for n >= 1, concave for n <= 1, also where a or b can be 0. Ranges
/// may reach below 0 by rounding.
struct BoundedNumber {
  LinearBound bound;
  Range range;
};
[[nodiscard]] BoundedNumber norm_of_two(double n, const BoundedNumber& a, const BoundedNumber& b);
/// |y_axis| times `plus` where y_axis > 0, times `minus` where it is < 0.
[[nodiscard]] BoundedNumber coordinate_magnitude(const LinearInput& in, int axis, double plus, double minus);
[[nodiscard]] inline BoundedNumber coordinate_magnitude(const LinearInput& in, int axis, double factor) {
  return coordinate_magnitude(in, axis, factor, factor);
}

}  // namespace blendwright::detail
