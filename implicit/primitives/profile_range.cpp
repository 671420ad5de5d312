// Bounds of gauges.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "implicit/eval/op.hpp"
#include "implicit/primitives/profile.hpp"

namespace blendwright::detail {
namespace {

constexpr double pi = std::numbers::pi;

/// What both ranges of one quantity leave.
Range both(Range a, Range b) {
  const Range r{std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
  return r.lo <= r.hi ? r : a;  // they meet but for rounding
}

/// q of (3) and (4) at cos k theta = c: it falls with c.
double reciprocal_radius(const Profile& p, double c) {
  if (p.kind == Profile::Kind::rose) return (1.0 + p.eps) / (p.a * (1.0 + p.eps * c));
  return (1.0 + p.sigma * std::pow(std::sqrt(0.5 * (1.0 - c)), p.m.exponent)) / p.a;
}

}  // namespace

Range cosine_range(Range x) {
  const double slack = 1e-15 * (4.0 + std::abs(x.lo) + std::abs(x.hi));
  x = {x.lo - slack, x.hi + slack};
  const double turn = std::ceil(x.lo / pi);
  const double a = std::cos(x.lo), b = std::cos(x.hi);
  Range c{std::min(a, b) - 1e-15, std::max(a, b) + 1e-15};
  for (const double t : {turn, turn + 1.0})
    if (t * pi <= x.hi)
      (std::remainder(t, 2.0) == 0.0 ? c.hi : c.lo) = std::remainder(t, 2.0) == 0.0 ? 1.0 : -1.0;
  return {std::max(c.lo, -1.0), std::min(c.hi, 1.0)};
}

std::optional<Range> angles(Range u, Range v) {
  if (u.contains(0.0) && v.contains(0.0)) return std::nullopt;
  // A convex set that misses the origin is seen under less than pi.
  const double cu = 0.5 * u.lo + 0.5 * u.hi, cv = 0.5 * v.lo + 0.5 * v.hi;
  Range around{0.0, 0.0};
  for (const double a : {u.lo, u.hi})
    for (const double b : {v.lo, v.hi}) {
      const double t = std::atan2(cu * b - cv * a, cu * a + cv * b);
      around = {std::min(around.lo, t), std::max(around.hi, t)};
    }
  const double middle = std::atan2(cv, cu);
  return Range{middle + around.lo - 4e-15, middle + around.hi + 4e-15};
}

PlanePart plane_box(Range u, Range v) {
  const Range mu = magnitude(u), mv = magnitude(v);
  PlanePart part{u, v, {std::hypot(mu.lo, mv.lo), std::hypot(mu.hi, mv.hi)}, angles(u, v)};
  part.r = part.r.widened(1e-15);
  part.centre_u = 0.5 * u.lo + 0.5 * u.hi;
  part.centre_v = 0.5 * v.lo + 0.5 * v.hi;
  part.reach = 0.5 * std::hypot(u.hi - u.lo, v.hi - v.lo) * (1.0 + 4e-15);
  return part;
}

PlanePart plane_disk(double u, double v, double radius) {
  const double r = std::hypot(u, v);
  PlanePart part{{u - radius, u + radius},
                 {v - radius, v + radius},
                 {std::max(0.0, r - radius), r + radius},
                 std::nullopt};
  part.r = part.r.widened(4e-15);
  if (r > radius) {
    const double middle = std::atan2(v, u), around = std::asin(radius / r) + 4e-15;
    part.theta = Range{middle - around, middle + around};
  }
  part.centre_u = u;
  part.centre_v = v;
  part.reach = radius;
  return part;
}

Range reciprocal_radius_range(const Profile& p, const std::optional<Range>& theta) {
  const Range radius = p.radius();
  const Range always = Range{1.0 / radius.hi, 1.0 / radius.lo}.widened(range_slack);
  if (!theta) return always;
  if (p.kind == Profile::Kind::lp) {
    const Range c = magnitude(cosine_range(*theta));
    const Range s = magnitude(cosine_range({theta->lo - 0.5 * pi, theta->hi - 0.5 * pi}));
    return both(always, Range{p.gauge(c.lo, s.lo), p.gauge(c.hi, s.hi)}.widened(range_slack));
  }
  // The kernels' cos k theta is off by some k ulp.
  const double slack = 1e-15 * p.k;
  Range c = cosine_range({p.k * theta->lo, p.k * theta->hi});
  c = {std::max(c.lo - slack, -1.0), std::min(c.hi + slack, 1.0)};
  return both(always, Range{reciprocal_radius(p, c.hi), reciprocal_radius(p, c.lo)}.widened(range_slack));
}

Range gauge_range(const Profile& p, const PlanePart& part, Range turn) {
  std::optional<Range> theta = part.theta;
  if (theta) theta = Range{theta->lo - turn.hi, theta->hi - turn.lo};
  const Range q = reciprocal_radius_range(p, theta);
  Range g = Range{part.r.lo * q.lo, part.r.hi * q.hi}.widened(range_slack);
  if (!turn.constant()) return g;
  if (p.kind == Profile::Kind::lp && turn.lo == 0.0) {
    const Range u = magnitude(part.u), v = magnitude(part.v);
    g = both(g, Range{p.gauge(u.lo, v.lo), p.gauge(u.hi, v.hi)}.widened(range_slack));
  }
  if (const double reach = part.reach * p.lipschitz(); reach < part.r.hi * q.hi) {
    const double c = std::cos(turn.lo), s = std::sin(turn.lo);
    const double middle =
        p.gauge(c * part.centre_u + s * part.centre_v, c * part.centre_v - s * part.centre_u);
    const double slack = 1e-13 * (middle + part.r.hi * q.hi);
    g = both(g, {std::max(0.0, middle - reach - slack), middle + reach + slack});
  }
  return g;
}

}  // namespace blendwright::detail
