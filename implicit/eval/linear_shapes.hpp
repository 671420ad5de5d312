#pragma once
// Linear bounds of functions from their shape: of one variable, convex and concave in turn, and of convex or
// concave functions of the place.
#include <span>

#include "implicit/eval/op.hpp"

namespace blendwright::detail {

enum class Curve { convex, concave };

// ---- Of one variable

/// A function at one place: its value, and its slopes to the left and to the right.
struct Knot {
  double at, value, left, right;
};
using KnotAt = Knot (*)(const void* body, double at);

/// g(u) for a continuous g that is `curves[i]` between joints i - 1 and i (joints rise; one curve more than
/// joints). Along the tangent in the middle or the chord of u's range, whichever leaves less: between two
/// places where it is known a convex function is below their chord and above their tangents, a concave one
/// the other way round. Of second order where g' is continuous. `slack`: what rounding of g can add; slopes
/// may be off by range_slack.
[[nodiscard]] LinearBound of_curves(const LinearBound& u, Range range, std::span<const double> joints,
                                    std::span<const Curve> curves, KnotAt at, const void* body, double slack);

/// max(u, 0), |u|.
[[nodiscard]] LinearBound positive_part(const LinearBound& u, Range range);
[[nodiscard]] LinearBound magnitude_bound(const LinearBound& u, Range range);
/// ln u for range.lo > 0, e^u for range.hi < 700; everything() else.
[[nodiscard]] LinearBound logarithm_bound(const LinearBound& u, Range range);
[[nodiscard]] LinearBound exponential_bound(const LinearBound& u, Range range);

/// The same bound, its value in the middle of the range when it was not inside.
[[nodiscard]] LinearBound recentred(const LinearBound& u, Range range);

/// Value and slope of an operation of one argument, both slopes being the same.
[[nodiscard]] Knot smooth_knot(const Op& op, const void* body, double at);

// ---- Of the place

/// The linear form n.y of local coordinates.
[[nodiscard]] LinearBound linear_form(const Vec3& n, const LinearInput& in);
/// |y|.
[[nodiscard]] LinearBound length_bound(const LinearInput& in);

/// A plane offset + gradient.y, in local coordinates.
struct Support {
  double offset;
  Vec3 gradient;
};
/// A convex (concave) function of the place that lies above (below) a plane: it is off it by most in a
/// corner. The plane may be any; one that touches near the middle leaves a rest of second order. steepness:
/// bounds the partials over the box, for the rounding of coordinates; slack: that of values.
[[nodiscard]] LinearBound supported_bound(const Op& op, const void* body, const LinearInput& in, Curve curve,
                                          const Support& plane, const Vec3& steepness, double slack);
/// The same with the tangent plane in the middle for a function that is ray-linear about the origin, as f(y)
/// = gradient.y there (Euler).
[[nodiscard]] LinearBound gauge_bound(const Op& op, const void* body, const LinearInput& in, Curve curve,
                                      const Vec3& steepness, double slack = 0.0);
/// For each coordinate the largest magnitude over the box.
[[nodiscard]] Vec3 reach_of(const LinearInput& in);

}  // namespace blendwright::detail
