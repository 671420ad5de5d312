// The closing seam of a closed blend.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kernel/geometry/curvature.hpp"
#include "verify/surface/surface_checks.hpp"

namespace blendwright {
namespace {

// Jet at the border v from inside: taken a hundred-millionth of the domain away and continued by its own
// Taylor series. Error: S and Su 1e-24 and 1e-16, Sv 1e-16, second derivatives 1e-8, each times the next
// derivative.
SurfaceJet border_jet(const Surface& blend, double u, double border, double inside) {
  SurfaceJet jet = blend.jet({u, inside});
  const double h = border - inside;
  jet.S += h * jet.Sv + 0.5 * h * h * jet.Svv;
  jet.Su += h * jet.Suv;
  jet.Sv += h * jet.Svv;
  return jet;
}

struct Mismatch {
  double gap, angle, curvature;
};

Mismatch mismatch(const SurfaceJet& a, const SurfaceJet& b) {
  const Vec3 na = unit_normal(a), nb = unit_normal(b);
  const double gap = (a.S - b.S).norm();
  // No normal on the line: the surface checks say so; here there is no angle to compare.
  if (na.isZero(0.0) || nb.isZero(0.0)) {
    const double unknown = 0.0 * (a.Su + a.Sv + b.Su + b.Sv).sum();  // NaN or 0
    return {gap, unknown, unknown};
  }
  const Vec3 across = na.cross(a.Su);
  const Vec3 same = na.dot(nb) < 0.0 ? Vec3(-nb) : nb;
  // Signed: a band that closes with opposite normals (Moebius) still has one tangent plane on the line.
  return {gap, plane_angle(na, nb).value,
          std::abs(normal_curvature(a, across, na) - normal_curvature(b, across, same))};
}

// NaN wins and stays.
double larger(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

}  // namespace

ClosingReport check_closing(const Surface& blend, int nu) {
  const SurfaceDomain domain = blend.domain();
  const double h = 1e-8 * domain.v.length();
  const double size =
      (blend.point({domain.u.lo, domain.v.lo}) - blend.point({domain.u.hi, domain.v.middle()})).norm();
  ClosingReport report;
  double worst = -1.0;
  for (int i = 0; i <= nu; ++i) {
    const double u = domain.u.at(static_cast<double>(i) / std::max(nu, 1));
    const SurfaceJet a = border_jet(blend, u, domain.v.lo, domain.v.lo + h);
    const SurfaceJet b = border_jet(blend, u, domain.v.hi, domain.v.hi - h);
    const auto [gap, angle, curvature] = mismatch(a, b);
    // Gaps are of rounding size on sound blends; then the place of the largest angle says more.
    const double rank = gap > 1e-9 * size ? 10.0 + gap / size : angle;
    if (rank > worst || std::isnan(gap)) {
      worst = rank;
      report.u = u;
      report.point = a.S;
    }
    report.gap = larger(report.gap, gap);
    report.angle = Radians(larger(report.angle.value, angle));
    report.curvature = larger(report.curvature, curvature);
  }
  return report;
}

}  // namespace blendwright
