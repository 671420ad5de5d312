#pragma once
// Rules that linear bounds of operations are made with.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

/// A function g of one variable u: its value and slope at u0, and its values at the ends of u's range.
struct AtThree {
  double value, slope, lo, hi;
};
/// g(u) for a convex (concave) g. What the tangent leaves out is of one sign and largest at an end of u's
/// range:
///   g(u) = g(u0) + g'(u0) (u - u0) + [0, max of the rest at u.lo and u.hi].
/// u0 = u.value lies in `range`. `slack`: what rounding of g and of this can add.
[[nodiscard]] LinearBound of_convex(const LinearBound& u, Range range, const AtThree& g, double slack);
[[nodiscard]] LinearBound of_concave(const LinearBound& u, Range range, const AtThree& g, double slack);

/// A concave function of the local coordinates: below its tangent at the centre, by most in a corner. The
/// gradient that the operation gives there must be one of a plane above the function. size: of the solid, for
/// the rounding of distances.
[[nodiscard]] LinearBound concave_bound(const Op& op, const void* body, const LinearInput& in, double size);

/// Value and local gradient of an operation without arguments at a point.
struct ValueGradient {
  double value;
  Vec3 gradient;
};
[[nodiscard]] ValueGradient scalar_gradient(const Op& op, const void* body, const Vec3& local);

/// The smaller and the larger of two functions, along the mean of their linear parts.
[[nodiscard]] LinearBound minimum_bound(const void* body, const LinearInput& in);
[[nodiscard]] LinearBound maximum_bound(const void* body, const LinearInput& in);
/// The sum, the negative.
[[nodiscard]] LinearBound added_bound(const void* body, const LinearInput& in);
[[nodiscard]] LinearBound negative_bound(const void* body, const LinearInput& in);

}  // namespace blendwright::detail
