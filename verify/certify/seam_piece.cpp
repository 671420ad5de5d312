#include "verify/certify/seam_piece.hpp"

#include <algorithm>
#include <optional>

#include "kernel/geometry/enclosure.hpp"
#include "verify/certify/model_figures.hpp"

namespace blendwright::detail {
namespace {

/// Blend, primary and trimline over a piece of v.
struct Enclosed {
  SurfaceEnclosure S{}, P{};
  CurveEnclosure line{};
  std::string unproven{};
  Enclosed(const Seam& seam, const TaylorModel& v) {
    const SurfaceDomain domain = seam.blend.domain();
    if (!seam.blend.enclose(seam.side == 0 ? domain.u.lo : domain.u.hi, v, S))
      S.unproven = "the blend's surface has no enclosure";
    if (!seam.pcurve->enclose(v, line)) line.unproven = "the trimline's curve has no enclosure";
    if (!seam.primary->enclose(line.D[0][0], line.D[0][1], P)) P.unproven = "the primary has no enclosure";
    for (const std::string* why : {&P.unproven, &line.unproven, &S.unproven})
      if (!why->empty()) unproven = *why;
  }
  [[nodiscard]] ModelVector blend_normal() const { return cross(S.Su, S.Sv); }
  [[nodiscard]] ModelVector primary_normal() const { return cross(P.Su, P.Sv); }
  /// Their derivatives along the trimline.
  [[nodiscard]] ModelVector blend_turn() const { return cross(S.Suv, S.Sv) + cross(S.Su, S.Svv); }
  [[nodiscard]] ModelVector primary_turn() const {
    const TaylorModel &u1 = line.D[1][0], &v1 = line.D[1][1];
    return cross(u1 * P.Suu + v1 * P.Suv, P.Sv) + cross(P.Su, u1 * P.Suv + v1 * P.Svv);
  }
};

ModelVector mean_from(const ModelVector& x, const Bounds& x0) {
  return {x[0].mean_from(x0), x[1].mean_from(x0), x[2].mean_from(x0)};
}
ModelVector widened(const ModelVector& x, double by) {
  const TaylorModel slack(Bounds(-by, by));
  return {x[0] + slack, x[1] + slack, x[2] + slack};
}

/// (1) and (2) of seam_piece.hpp at the end e; nullopt when the trimline does not stop there.
std::optional<Bounds> angle_to_stop(const Seam& seam, const Enclosed& over, const TaylorModel& v, double e,
                                    double least_normal) {
  const Enclosed there(seam, TaylorModel::parameter(e, e));
  const double nS = length(there.blend_normal()).hi, nP = length(there.primary_normal()).hi;
  if (!(nS <= 0.25 * least_normal)) return std::nullopt;
  const Bounds x0 = (Bounds(e) - Bounds(v.coefficient(0))) / Bounds(v.coefficient(1));
  if (!x0.finite()) return std::nullopt;
  const Bounds inside(std::max(x0.lo, -1.0), std::min(x0.hi, 1.0));
  const ModelVector mS = mean_from(over.blend_turn(), inside), mP = mean_from(over.primary_turn(), inside);
  const double t0 = rounded_down((0.5 * least_normal - nS) / length(mS).hi);
  if (!(t0 > 0.0)) return std::nullopt;
  const Bounds angle = angle_between(widened(mS, rounded_up(nS / t0)), widened(mP, rounded_up(nP / t0)));
  return Bounds{0.0, angle.hi};  // a piece shorter than t0 has no angle of its own
}

}  // namespace

SeamPiece enclosed_piece(const Seam& seam, const Interval& v, double least_normal) {
  SeamPiece piece;
  piece.v = v;
  piece.gap = piece.angle = piece.curvature = Bounds{0.0, unbounded().hi};
  const TaylorModel at = TaylorModel::parameter(v.lo, v.hi);
  const Enclosed over(seam, at);
  piece.unproven = over.unproven;
  if (!piece.unproven.empty()) return piece;

  piece.gap = length(over.S.S - over.P.S);
  const ModelVector nS = over.blend_normal(), nP = over.primary_normal();
  piece.angle = angle_between(nS, nP);
  const Bounds cosine = dot(nS, nP).range();
  if (!(cosine.mignitude() > 0.0)) {
    for (const double e : {v.lo, v.hi})
      if (const std::optional<Bounds> angle = angle_to_stop(seam, over, at, e, least_normal)) {
        piece.stops = true;
        piece.angle = intersection(piece.angle, *angle);
      }
    return piece;
  }
  const ModelVector across = cross(nP, velocity(over.P, over.line));
  const TaylorModel kS = curvature_along(over.S, nS, across), kP = curvature_along(over.P, nP, across);
  const Bounds jump = (cosine.lo > 0.0 ? kS - kP : kS + kP).range();
  piece.curvature = {jump.mignitude(), jump.magnitude()};
  return piece;
}

}  // namespace blendwright::detail
