#include "implicit/eval/linear_rules.hpp"

#include <algorithm>
#include <cmath>

#include "implicit/eval/op.hpp"

namespace blendwright::detail {
namespace {

/// Of the values of an exact distance: a few dozen operations of half a unit of round-off each.
constexpr double distance_rounding = 128.0 * std::numeric_limits<double>::epsilon();

}  // namespace

LinearBound of_convex(const LinearBound& u, Range range, const AtThree& g, double slack) {
  const double at_lo = g.lo - g.value - g.slope * (range.lo - u.value);
  const double at_hi = g.hi - g.value - g.slope * (range.hi - u.value);
  LinearBound bound{g.value, g.slope * u.slope, {g.slope * u.rest.lo, g.slope * u.rest.hi}};
  if (g.slope < 0.0) std::swap(bound.rest.lo, bound.rest.hi);
  bound.rest.hi += std::max({0.0, at_lo, at_hi});
  const double size =
      std::abs(g.value) + std::abs(g.lo) + std::abs(g.hi) +
      std::abs(g.slope) * (std::abs(u.value) + std::abs(range.lo) + std::abs(range.hi) + u.slope.lpNorm<1>());
  return bound.widened(slack + 8.0 * std::numeric_limits<double>::epsilon() * size);
}

LinearBound of_concave(const LinearBound& u, Range range, const AtThree& g, double slack) {
  return -1.0 * of_convex(u, range, {-g.value, -g.slope, -g.lo, -g.hi}, slack);
}

ValueGradient scalar_gradient(const Op& op, const void* body, const Vec3& local) {
  double out[4 * batch_size];
  const KernelInput in{&local.x(), &local.y(), &local.z(), nullptr, nullptr, 0, 1};
  op.scalar.run[1](body, in, out);
  return {out[0], {out[batch_size], out[2 * batch_size], out[3 * batch_size]}};
}

LinearBound concave_bound(const Op& op, const void* body, const LinearInput& in, double size) {
  const ValueGradient f = scalar_gradient(op, body, in.centre);
  LinearBound bound{f.value, in.slope(f.gradient), {0.0, 0.0}};
  for (unsigned k = 0; k < 8; ++k) {
    const Vec3 y = in.corner(k);
    bound.rest.lo =
        std::min(bound.rest.lo, scalar_value(op, body, y) - f.value - f.gradient.dot(y - in.centre));
  }
  const double reach = in.local.lo.cwiseAbs().cwiseMax(in.local.hi.cwiseAbs()).sum();
  return bound.widened(distance_rounding * (size + reach) + 2.0 * in.slack.sum());
}

LinearBound minimum_bound(const void*, const LinearInput& in) {
  const LinearBound &a = in.args[0], &b = in.args[1];
  const double value = 0.5 * (a.value + b.value);
  const Vec3 slope = 0.5 * (a.slope + b.slope);
  const Range da = difference(a, value, slope), db = difference(b, value, slope);
  return {value, slope, {std::min(da.lo, db.lo), std::min(da.hi, db.hi)}};
}

LinearBound maximum_bound(const void*, const LinearInput& in) {
  const LinearBound &a = in.args[0], &b = in.args[1];
  const double value = 0.5 * (a.value + b.value);
  const Vec3 slope = 0.5 * (a.slope + b.slope);
  const Range da = difference(a, value, slope), db = difference(b, value, slope);
  return {value, slope, {std::max(da.lo, db.lo), std::max(da.hi, db.hi)}};
}

LinearBound added_bound(const void*, const LinearInput& in) { return in.args[0] + in.args[1]; }

LinearBound negative_bound(const void*, const LinearInput& in) { return -1.0 * in.args[0]; }

}  // namespace blendwright::detail
