#include "verify/certify/seam_piece.hpp"

#include <algorithm>
#include <numbers>

#include "kernel/geometry/enclosure.hpp"

namespace blendwright::detail {
namespace {

Bounds intersection(const Bounds& a, const Bounds& b) {
  const double lo = std::max(a.lo, b.lo), hi = std::min(a.hi, b.hi);
  return lo <= hi ? Bounds{lo, hi} : Bounds{std::min(lo, hi), std::max(lo, hi)};
}

/// Bounds of |x|: from the ranges of the coordinates, and from the model of |x|^2, which knows how they go
/// together.
Bounds length(const ModelVector& x) {
  Bounds sum;
  for (const TaylorModel& c : x) sum = sum + square(c.range());
  const Bounds apart = sqrt(sum);
  const Bounds together = dot(x, x).range();
  if (!together.finite()) return apart.finite() ? apart : Bounds{0.0, unbounded().hi};
  return intersection(apart, sqrt(Bounds{std::max(together.lo, 0.0), std::max(together.hi, 0.0)}));
}

/// Normal curvature (3) of seam.hpp in the direction of the tangent plane nearest to t, about the unit normal
/// along n.
TaylorModel curvature_along(const SurfaceEnclosure& s, const ModelVector& n, const ModelVector& t) {
  const TaylorModel E = dot(s.Su, s.Su), F = dot(s.Su, s.Sv), G = dot(s.Sv, s.Sv);
  const TaylorModel du = dot(s.Su, t), dv = dot(s.Sv, t);
  const TaylorModel a = G * du - F * dv, b = E * dv - F * du;  // times |Su x Sv|^2, which cancels
  const TaylorModel second = a * a * dot(s.Suu, n) + 2.0 * (a * b * dot(s.Suv, n)) + b * b * dot(s.Svv, n);
  const TaylorModel first = a * a * E + 2.0 * (a * b * F) + b * b * G;
  return second * pow(dot(n, n), -0.5) * inverse(first);
}

}  // namespace

SeamPiece enclosed_piece(const Seam& seam, const Interval& v) {
  SeamPiece piece;
  piece.v = v;
  piece.gap = piece.curvature = Bounds{0.0, unbounded().hi};
  piece.angle = Bounds{0.0, rounded_up(0.5 * std::numbers::pi)};
  const SurfaceDomain domain = seam.blend.domain();
  const TaylorModel at = TaylorModel::parameter(v.lo, v.hi);
  SurfaceEnclosure S, P;
  CurveEnclosure line;
  if (!seam.blend.enclose(seam.side == 0 ? domain.u.lo : domain.u.hi, at, S))
    S.unproven = "the blend's surface has no enclosure";
  if (!seam.pcurve->enclose(at, line)) line.unproven = "the trimline's curve has no enclosure";
  if (!seam.primary->enclose(line.D[0][0], line.D[0][1], P)) P.unproven = "the primary has no enclosure";
  for (const std::string* why : {&P.unproven, &line.unproven, &S.unproven})
    if (!why->empty()) piece.unproven = *why;
  if (!piece.unproven.empty()) return piece;

  piece.gap = length(S.S - P.S);
  const ModelVector nS = cross(S.Su, S.Sv), nP = cross(P.Su, P.Sv);
  const Bounds cosine = dot(nS, nP).range();
  piece.angle = intersection(
      piece.angle, first_quadrant_angle(length(cross(nS, nP)), {cosine.mignitude(), cosine.magnitude()}));
  if (cosine.mignitude() > 0.0) {
    const ModelVector across = cross(nP, velocity(P, line));
    const TaylorModel kS = curvature_along(S, nS, across), kP = curvature_along(P, nP, across);
    const Bounds jump = (cosine.lo > 0.0 ? kS - kP : kS + kP).range();
    piece.curvature = {jump.mignitude(), jump.magnitude()};
  }
  return piece;
}

}  // namespace blendwright::detail
