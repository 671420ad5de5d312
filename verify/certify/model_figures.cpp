#include "verify/certify/model_figures.hpp"

#include <algorithm>
#include <numbers>

namespace blendwright::detail {

Bounds intersection(const Bounds& a, const Bounds& b) {
  const double lo = std::max(a.lo, b.lo), hi = std::min(a.hi, b.hi);
  return lo <= hi ? Bounds{lo, hi} : Bounds{std::min(lo, hi), std::max(lo, hi)};
}

Bounds length(const ModelVector& x) {
  Bounds sum;
  for (const TaylorModel& c : x) sum = sum + square(c.range());
  const Bounds apart = sqrt(sum);
  const Bounds together = dot(x, x).range();
  if (!together.finite()) return apart.finite() ? apart : Bounds{0.0, unbounded().hi};
  return intersection(apart, sqrt(Bounds{std::max(together.lo, 0.0), std::max(together.hi, 0.0)}));
}

TaylorModel curvature_along(const SurfaceEnclosure& s, const ModelVector& n, const ModelVector& t) {
  const TaylorModel E = dot(s.Su, s.Su), F = dot(s.Su, s.Sv), G = dot(s.Sv, s.Sv);
  const TaylorModel du = dot(s.Su, t), dv = dot(s.Sv, t);
  const TaylorModel a = G * du - F * dv, b = E * dv - F * du;  // times |Su x Sv|^2, which cancels
  const TaylorModel second = a * a * dot(s.Suu, n) + 2.0 * (a * b * dot(s.Suv, n)) + b * b * dot(s.Svv, n);
  const TaylorModel first = a * a * E + 2.0 * (a * b * F) + b * b * G;
  return second * pow(dot(n, n), -0.5) * inverse(first);
}

Bounds angle_between(const ModelVector& nS, const ModelVector& nP) {
  const Bounds cosine = dot(nS, nP).range();
  return intersection({0.0, rounded_up(0.5 * std::numbers::pi)},
                      first_quadrant_angle(length(cross(nS, nP)), {cosine.mignitude(), cosine.magnitude()}));
}

}  // namespace blendwright::detail
