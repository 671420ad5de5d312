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

/// For n < 1 next to a plane where one number is 0 and the slope infinite: along the chords through the
/// middle. What is left is concave, so least in a corner, and below the tangent plane in the middle.
LinearBound along_chords(double n, const BoundedNumber& a, const BoundedNumber& b, const NormAt& middle) {
  const double mid_a = 0.5 * (a.range.lo + a.range.hi), mid_b = 0.5 * (b.range.lo + b.range.hi);
  const double reach_a = a.range.hi - a.range.lo, reach_b = b.range.hi - b.range.lo;
  const double by_a =
      reach_a > 0.0 ? (NormAt(n, a.range.hi, mid_b).value - NormAt(n, a.range.lo, mid_b).value) / reach_a
                    : 0.0;
  const double by_b =
      reach_b > 0.0 ? (NormAt(n, mid_a, b.range.hi).value - NormAt(n, mid_a, b.range.lo).value) / reach_b
                    : 0.0;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Range rest{infinity, -infinity};
  for (const double x : {a.range.lo, a.range.hi})
    for (const double y : {b.range.lo, b.range.hi}) {
      rest.lo = std::min(rest.lo, NormAt(n, x, y).value - (by_a * x + by_b * y));
      rest.hi = std::max(rest.hi, (middle.by_a - by_a) * x + (middle.by_b - by_b) * y);
    }
  LinearBound bound = by_a * a.bound + by_b * b.bound;
  bound.rest = {bound.rest.lo + rest.lo, bound.rest.hi + rest.hi};
  const double size = (middle.by_a + by_a) * a.range.hi + (middle.by_b + by_b) * b.range.hi;
  return bound.widened(8.0 * range_slack * (1.0 + 1.0 / n) * size);
}

Range not_negative(Range r) { return {std::max(r.lo, 0.0), std::max(r.hi, 0.0)}; }

}  // namespace

bool in_one_octant(const LinearInput& in) {
  const Vec3 reach = reach_of(in);
  for (int i = 0; i < 3; ++i) {
    const double least = magnitude(in.local.axis(i)).lo;
    if (!(least > least_share * reach.maxCoeff()) || least < 1e-100) return false;
  }
  return true;
}

LinearBound norm_bound(const Op& op, const void* body, const LinearInput& in, bool convex,
                       const Vec3& steepness) {
  if (convex) return gauge_bound(op, body, in, Curve::convex, steepness);
  if (!in_one_octant(in)) return constant_bound(Range::everything());
  // A concave f >= 0 has the partials f_i <= f/y_i.
  Vec3 steepest;
  for (int i = 0; i < 3; ++i)
    steepest[i] = scalar_value(op, body, reach_of(in)) / magnitude(in.local.axis(i)).lo;
  return gauge_bound(op, body, in, Curve::concave, steepest);
}

BoundedNumber norm_of_two(double n, const BoundedNumber& first, const BoundedNumber& second) {
  const Range a = not_negative(first.range), b = not_negative(second.range);
  const double slack = 4.0 * range_slack * (1.0 + 1.0 / n);
  const Range range = Range{NormAt(n, a.lo, b.lo).value, NormAt(n, a.hi, b.hi).value}.widened(slack);
  const bool convex = n >= 1.0;
  const LinearBound u = recentred(first.bound, a), v = recentred(second.bound, b);
  const double at_a = std::clamp(u.value, a.lo, a.hi), at_b = std::clamp(v.value, b.lo, b.hi);
  const NormAt middle(n, at_a, at_b);
  const bool usable = convex || std::min(at_a, at_b) > least_share * std::max(at_a, at_b);
  if (!std::isfinite(range.hi) || !usable) return {constant_bound(range), range};
  if (!convex && std::min(a.lo, b.lo) <= 1e-3 * std::max(a.hi, b.hi))
    return {along_chords(n, {u, a}, {v, b}, middle), range};
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

BoundedNumber coordinate_magnitude(const LinearInput& in, int axis, double plus, double minus) {
  constexpr double zero[] = {0.0};
  constexpr Curve convex[] = {Curve::convex, Curve::convex};
  const double factors[] = {plus, minus};
  const auto at = [](const void* of, double y) {
    const auto* f = static_cast<const double*>(of);
    return Knot{y, y < 0.0 ? -f[1] * y : f[0] * y, y > 0.0 ? f[0] : -f[1], y >= 0.0 ? f[0] : -f[1]};
  };
  const Range y = in.local.axis(axis);
  const double lo = at(factors, y.lo).value, hi = at(factors, y.hi).value;
  const Range range{y.contains(0.0) ? 0.0 : std::min(lo, hi), std::max(lo, hi)};
  return {of_curves(linear_form(Vec3::Unit(axis), in), y, zero, convex, at, factors, 0.0),
          range.widened(4.0 * std::numeric_limits<double>::epsilon())};
}

}  // namespace blendwright::detail
