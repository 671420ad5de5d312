#include "app/pipeline/boundary_strip.hpp"

namespace blendwright {
namespace {

struct ZeroLine {
  CurveDomain range;
  [[nodiscard]] CurveJet<2> jet(double v) const {
    return {{Vec2(0.0, v), Vec2(0.0, 1.0), Vec2::Zero(), Vec2::Zero()}};
  }
  void enclose(const TaylorModel& v, CurveEnclosure& out) const {
    out.D[0][1] = v;
    out.D[1][1] = 1.0;
  }
  [[nodiscard]] CurveDomain domain() const { return range; }
};

}  // namespace

SurfacePartials BoundaryStrip::partials(UV p) const {
  const EndSeries data = end_.series(p.v);
  const bool second = end_.continuity == Continuity::G2;
  SurfacePartials d;
  for (Vec3& x : d.d) x.setZero();
  for (int k = 0; k <= 2; ++k) {
    const Vec3 C = derivative(data.C, k), T = derivative(data.T, k);
    const Vec3 D = second ? derivative(data.D, k) : Vec3::Zero();
    d(0, k) = C + p.u * T + 0.5 * p.u * p.u * D;
    d(1, k) = T + p.u * D;
    d(2, k) = D;
  }
  d(0, 3) = derivative(data.C, 3);
  return d;
}

SurfaceJet BoundaryStrip::jet(UV p) const {
  const SurfacePartials d = partials(p);
  return {d(0, 0), d(1, 0), d(0, 1), d(2, 0), d(1, 1), d(0, 2)};
}

void BoundaryStrip::enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const {
  if (!u.is_zero() || !end_.enclosure) {
    out.unproven = "the typed data are enclosed along their line only";
    return;
  }
  const EndEnclosure data = end_.enclosure(v);
  out = {data.C[0], data.T[0], data.C[1],    end_.continuity == Continuity::G2 ? data.D : ModelVector{},
         data.T[1], data.C[2], data.unproven};
}

SurfaceDomain BoundaryStrip::domain() const {
  constexpr double width = 0.01;  // of the blend's own u: only the neighbourhood of the line is meant
  const Interval u = side_ == 0 ? Interval{-width, 0.0} : Interval{0.0, width};
  return {u, end_.domain.v, false, end_.domain.closed};
}

Curve2 BoundaryStrip::line() const { return ZeroLine{end_.domain}; }

}  // namespace blendwright
