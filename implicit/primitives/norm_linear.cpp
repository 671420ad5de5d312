#include "implicit/primitives/norm_linear.hpp"

#include <algorithm>
#include <cmath>

namespace blendwright::detail {
namespace {

/// Coordinates that are smaller than this share of the largest have partials that are out of hand for n < 1.
constexpr double least_share = 1e-30;

/// The norm of two numbers >= 0 and its partials.
struct NormAt {
  double value, by_a, by_b;
  NormAt(double n, double a, double b) {
    const double most = std::max(a, b), q = most > 0.0 ? std::min(a, b) / most : 0.0;
    const double sum = 1.0 + std::pow(q, n), root = std::pow(sum, 1.0 / n), large = root / sum;
    const double small = q > 0.0 ? std::pow(q, n - 1.0) * large : 0.0;
    value = most * root;
    by_a = a >= b ? large : small;
    by_b = a >= b ? small : large;
  }
};

Range not_negative(Range r) { return {std::max(r.lo, 0.0), std::max(r.hi, 0.0)}; }

}  // namespace

LinearBound norm_bound(const Op& op, const void* body, const LinearInput& in, bool convex,
                       const Vec3& steepness) {
  if (convex) return gauge_bound(op, body, in, Curve::convex, steepness);
  // A concave f >= 0 has the partials f_i <= f/y_i.
  const Vec3 reach = reach_of(in);
  Vec3 steepest;
  for (int i = 0; i < 3; ++i) {
    const double least = magnitude(in.local.axis(i)).lo;
    if (!(least > least_share * reach.maxCoeff()) || least < 1e-100)
      return constant_bound(Range::everything());
    steepest[i] = scalar_value(op, body, reach) / least;
  }
  return gauge_bound(op, body, in, Curve::concave, steepest);
}

BoundedNumber norm_of_two(double n, const BoundedNumber& first, const BoundedNumber& second) {
  const Range a = not_negative(first.range), b = not_negative(second.range);
  const double slack = 4.0 * range_slack * (1.0 + 1.0 / n);
  const Range range = Range{NormAt(n, a.lo, b.lo).value, NormAt(n, a.hi, b.hi).value}.widened(slack);
  const bool convex = n >= 1.0;
  const double largest = std::max(a.hi, b.hi), least = std::min(a.lo, b.lo);
  if (!std::isfinite(range.hi) || (!convex && least <= least_share * largest))
    return {constant_bound(range), range};
  const LinearBound u = recentred(first.bound, a), v = recentred(second.bound, b);
  const double at_a = std::clamp(u.value, a.lo, a.hi), at_b = std::clamp(v.value, b.lo, b.hi);
  const NormAt middle(n, at_a, at_b);
  double most = 0.0;
  for (const double x : {a.lo, a.hi})
    for (const double y : {b.lo, b.hi}) {
      // The tangent plane goes through the origin.
      const double off = NormAt(n, x, y).value - (middle.by_a * x + middle.by_b * y);
      most = std::max(most, convex ? off : -off);
    }
  LinearBound bound = middle.by_a * u + middle.by_b * v;
  (convex ? bound.rest.hi : bound.rest.lo) += convex ? most : -most;
  const double size = range.hi + middle.by_a * a.hi + middle.by_b * b.hi;
  return {bound.widened(slack * size), range};
}

BoundedNumber coordinate_magnitude(const LinearInput& in, int axis, double factor) {
  const LinearBound y = linear_form(factor * Vec3::Unit(axis), in);
  const Range local = in.local.axis(axis);
  const Range range{factor * local.lo, factor * local.hi};
  return {magnitude_bound(y, range), magnitude(range).widened(4.0 * std::numeric_limits<double>::epsilon())};
}

}  // namespace blendwright::detail
