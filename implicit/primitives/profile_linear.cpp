#include "implicit/primitives/profile_linear.hpp"

#include <algorithm>
#include <cmath>

namespace blendwright::detail {

namespace {

/// x^e over a range of [0, 1], any e.
Range power_range(Range x, double e) {
  const double a = std::pow(x.lo, e), b = std::pow(x.hi, e);
  return {std::min(a, b), std::max(a, b)};
}

Range product(Range a, Range b) {
  const auto [lo, hi] = std::minmax({a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi});
  return {lo, hi};
}
Range sum(Range a, Range b) { return {a.lo + b.lo, a.hi + b.hi}; }
Range scaled(double factor, Range a) { return product({factor, factor}, a); }

/// q + q'' of (3): with i = 1/(1 + eps cos), q'' = q (eps k^2 cos i + 2 (eps k sin i)^2).
Range rose_bend(const Profile& p, Range c, Range s) {
  const Range i{1.0 / (1.0 + p.eps * c.hi), 1.0 / (1.0 + p.eps * c.lo)}, q = scaled((1.0 + p.eps) / p.a, i);
  const Range ratio = magnitude(scaled(p.eps * p.k, product(s, i)));
  const Range terms = sum(scaled(p.eps * p.k * p.k, product(c, i)), scaled(2.0, product(ratio, ratio)));
  return product(q, sum({1.0, 1.0}, terms));
}

}  // namespace

std::optional<Range> bend_range(const Profile& p, Range theta) {
  const double slack = 4e-15 * p.k;
  const auto around = [&](double shift) {
    const Range c = cosine_range({p.k * theta.lo + shift, p.k * theta.hi + shift});
    return Range{std::max(c.lo - slack, -1.0), std::min(c.hi + slack, 1.0)};
  };
  const Range c = around(0.0);
  if (p.kind == Profile::Kind::rose) {
    constexpr double right_angle = 1.5707963267948966;
    return rose_bend(p, c, around(-right_angle));
  }
  // (4): s^2 = (1 - cos k theta)/2, q + q'' = (1 + sigma (s^m + (k/2)^2 (m (m - 1) s^(m-2) (1 - s^2) - m
  // s^m)))/a.
  const Range s2{0.5 * (1.0 - c.hi), 0.5 * (1.0 - c.lo)};
  const double m = p.m.exponent, k2 = 0.25 * p.k * p.k;
  if (m < 2.0 && s2.lo <= 1e-12) return std::nullopt;
  const Range at = power_range(s2, 0.5 * m), below = power_range(s2, 0.5 * m - 1.0);
  const Range away{1.0 - s2.hi, 1.0 - s2.lo};  // 1 - s^2
  const Range terms = sum(scaled(1.0 - k2 * m, at), scaled(k2 * m * (m - 1.0), product(below, away)));
  return scaled(1.0 / p.a, sum({1.0, 1.0}, scaled(p.sigma, terms)));
}

BoundedNumber gauge_linear(const Profile& p, const LinearInput& in) {
  const PlanePart part = plane_box(in.local.axis(0), in.local.axis(1));
  const Range range = gauge_range(p, part);
  if (p.kind == Profile::Kind::lp) {
    const BoundedNumber g = norm_of_two(p.n.exponent, coordinate_magnitude(in, 0, 1.0 / p.a),
                                        coordinate_magnitude(in, 1, 1.0 / p.b));
    return {g.bound, range};
  }
  const BoundedNumber only_range{constant_bound(range), range};
  if (!part.theta || !(part.r.lo > 1e-6 * part.r.hi)) return only_range;
  const std::optional<Range> bend = bend_range(p, *part.theta);
  if (!bend) return only_range;
  const Vec3 c = in.centre;
  const Profile::Slopes at = p.slopes(c.x(), c.y());
  const Vec3 gradient(at.by_u, at.by_v, 0.0);
  // The largest (P - C)^2 of the box, in two corners of a diagonal or the other two.
  double far = 0.0;
  for (unsigned k = 0; k < 4; ++k) far = std::max(far, (in.corner(k) - c).head<2>().squaredNorm());
  const double least = std::min(0.0, bend->lo), most = std::max(0.0, bend->hi);
  const double half = 0.5 * far * (1.0 + range_slack) / part.r.lo;
  // Slopes are off by some k ulp of the largest.
  const double steepest = std::hypot(at.by_u, at.by_v);
  const double slack =
      range_slack * p.k * (range.hi + steepest * part.r.hi) + 4.0 * p.lipschitz() * in.slack.sum();
  return {LinearBound{at.value, in.slope(gradient), {least * half, most * half}}.widened(slack), range};
}

}  // namespace blendwright::detail
