#include "verify/continuity/seam_probe.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "kernel/geometry/curvature.hpp"
#include "kernel/geometry/project.hpp"

namespace blendwright::detail {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// A point this near to the trimline, relative to the trimline's length, may use the second-order distance.
constexpr double near = 1e-5;
// |Su x Sv| below this part of its mean is no normal (and a trimline slower than this part of its mean is a
// cusp).
constexpr double vanishing = 1e-9;
// How far the one-sided limit is taken, relative to the domain.
constexpr double inside = 1e-6;

}  // namespace

SeamProbe::SeamProbe(const Seam& seam) : seam_(seam), primary_(*seam.primary) {
  const SurfaceDomain domain = seam.blend.domain();
  domain_ = domain.v;
  u_ = seam.side == 0 ? domain.u.lo : domain.u.hi;
  constexpr int probes = 8;
  double speed_u = 0.0, speed_v = 0.0;
  for (int i = 0; i < probes; ++i) {
    const SurfaceJet jet = seam.blend.jet({u_, domain_.at((i + 0.5) / probes)});
    speed_u += jet.Su.norm() / probes;
    speed_v += jet.Sv.norm() / probes;
  }
  length_ = speed_v * domain_.length();
  area_ = speed_u * speed_v;
}

UV SeamProbe::search(const Vec3& point, std::optional<UV> guess) const {
  if (!guess) return closest_point(primary_, point).at;
  const Foot local = closest_point(primary_, point, *guess);
  // A continued foot that is not near may have stuck on another sheet.
  if (local.distance <= near * length_) return local.at;
  const Foot global = closest_point(primary_, point);
  return global.distance < local.distance ? global.at : local.at;
}

SeamProbe::Place SeamProbe::place(double v, std::optional<UV> guess) const {
  Place at;
  at.blend = seam_.blend.jet({u_, v});
  if (seam_.pcurve) {
    const CurveJet<2> line = seam_.pcurve->jet(v);
    at.foot = {line.C().x(), line.C().y()};
    at.primary = primary_.jet(at.foot);
    at.C1 = at.primary.Su * line.C1().x() + at.primary.Sv * line.C1().y();
  } else {
    at.foot = at.blend.S.allFinite() ? search(at.blend.S, guess) : UV{nan, nan};
    at.primary = primary_.jet(at.foot);
    at.C1 = at.blend.Sv;
  }
  return at;
}

double SeamProbe::distance_to_primary(const Place& at) const {
  const Vec3 offset = at.blend.S - at.primary.S;
  const double gap = offset.norm();
  if (!seam_.pcurve || gap == 0.0 || !std::isfinite(gap)) return gap;
  const Vec3 n = unit_normal(at.primary);
  if (gap > near * length_ || n.isZero(0.0)) return closest_point(primary_, at.blend.S, at.foot).distance;
  // Height over the osculating paraboloid; the first neglected term is |k'| along^3 / 6.
  const double height = offset.dot(n);
  const Vec3 along = offset - height * n;
  const double bend = along.norm() > 1e-3 * gap ? normal_curvature(at.primary, along, n) : 0.0;
  return std::abs(height - 0.5 * bend * along.squaredNorm());
}

double SeamProbe::least_normal() const { return vanishing * area_; }

bool SeamProbe::degenerate(const Place& at) const {
  // Only numbers have a limit: a value that is not one must be seen where it is.
  if (!(at.blend.Su + at.blend.Sv + at.primary.Su + at.primary.Sv).allFinite()) return false;
  return at.blend.Su.cross(at.blend.Sv).norm() <= least_normal() || unit_normal(at.primary).isZero(0.0) ||
         at.C1.norm() * domain_.length() <= vanishing * length_;
}

void SeamProbe::add_directions(const Place& at, SeamSample& sample) const {
  const Vec3 nP = unit_normal(at.primary);
  Vec3 nS = unit_normal(at.blend);
  if (nS.isZero(0.0) || nP.isZero(0.0) || at.C1.isZero(0.0)) {
    sample.angle = sample.curvature = sample.transverse = sample.fold = nan;
    return;
  }
  sample.angle = plane_angle(nS, nP).value;
  if (nS.dot(nP) < 0.0) nS = -nS;
  const Vec3 across = nP.cross(at.C1);
  sample.curvature =
      std::abs(normal_curvature(at.blend, across, nS) - normal_curvature(at.primary, across, nP));
  const Vec3& Su = at.blend.Su;
  sample.transverse = Su.cross(at.C1).norm() / (Su.norm() * at.C1.norm());
  const double towards_kept = Su.dot(across) / (Su.norm() * across.norm()) * (seam_.kept_left ? 1.0 : -1.0);
  sample.fold = seam_.side == 0 ? towards_kept : -towards_kept;
}

SeamSample SeamProbe::measure(double v, std::optional<UV> guess) const {
  const Place at = place(v, guess);
  SeamSample sample;
  sample.v = v;
  sample.point = at.blend.S;
  sample.foot = at.foot;
  sample.gap = (at.blend.S - at.primary.S).norm();
  sample.surface_gap = distance_to_primary(at);
  if (degenerate(at)) {
    const double step = inside * domain_.length();
    add_directions(place(v + step <= domain_.hi ? v + step : v - step, at.foot), sample);
  } else {
    add_directions(at, sample);
  }
  return sample;
}

}  // namespace blendwright::detail
