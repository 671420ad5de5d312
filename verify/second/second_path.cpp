#include "verify/second/second_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/geometry/rigid_motion.hpp"
#include "verify/second/differences.hpp"
#include "verify/second/spline_step.hpp"

namespace blendwright {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double roundings = 64.0;
/// |Su x Sv| below this part of what it is elsewhere is no normal.
constexpr double vanishing = 1e-6;
/// A joint is closed when it is open by less than this part of its length.
constexpr double closed_part = 1e-6;

double largest(const Vec3& p) { return p.cwiseAbs().maxCoeff(); }

/// Both tangents at a point, and how far they may be off.
struct Tangents {
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
  double error_a = 0.0, error_b = 0.0;
  [[nodiscard]] Vec3 normal() const { return a.cross(b); }
  /// (6)
  [[nodiscard]] double angle_error() const {
    const double lengths = a.norm() * b.norm();
    return (10.0 * (error_a * b.norm() + error_b * a.norm()) + roundings * eps * lengths) / normal().norm();
  }
};

/// Where a surface may be asked around `t`: a closed direction goes on, an open one ends.
Interval room(const Interval& range, bool closed, double t) {
  return closed ? Interval{t - 0.5 * range.length(), t + 0.5 * range.length()} : range;
}

/// Both derivatives of a surface. `around_v`: a closed v is asked on both sides of `at`, else from inside
/// only.
Tangents tangents(const Surface& surface, const SecondSurface& second, UV at, bool around_v = true) {
  if (const auto* spline = surface.target<BSplineSurface>()) {
    const detail::SplineTangents t = detail::complex_step(*spline, at);
    return {t.Su, t.Sv, t.error_u, t.error_v};
  }
  if (const auto* moved = surface.target<PlacedSurface>())
    if (moved->shape.target<BSplineSurface>()) {
      const Tangents t = tangents(moved->shape, second, at, around_v);
      return {moved->motion.R * t.a, moved->motion.R * t.b, t.error_a, t.error_b};
    }
  const SurfaceDomain d = surface.domain();
  const auto along_u = [&](double u) { return second.point({u, at.v}); };
  const auto along_v = [&](double v) { return second.point({at.u, v}); };
  const detail::Derivative u = detail::difference_quotient(along_u, at.u, room(d.u, d.u_closed, at.u));
  const detail::Derivative v =
      detail::difference_quotient(along_v, at.v, room(d.v, d.v_closed && around_v, at.v));
  return {u.value, v.value, u.error, v.error};
}

double angle_between(const Vec3& m, const Vec3& n) {
  return std::atan2(m.cross(n).norm(), std::abs(m.dot(n)));  // (3)
}

/// Largest coordinate of what a point of the surface is computed from.
double magnitude(const Surface& surface, const Vec3& point) {
  double m = largest(point);
  const auto* moved = surface.target<PlacedSurface>();
  if (moved) m += largest(moved->motion.t);
  const auto* spline = (moved ? moved->shape : surface).target<BSplineSurface>();
  return spline ? std::max(m, detail::largest_control(*spline)) : m;
}

/// Keeps the comparison that comes nearest to its bound, or goes furthest beyond it.
void compare(SecondFigure& figure, const SecondFigure& next) {
  if (!std::isfinite(next.first) || !std::isfinite(next.second) || !std::isfinite(next.bound)) return;
  const std::size_t places = figure.places + 1;
  if (figure.places == 0 || next.difference * figure.bound > figure.difference * next.bound) figure = next;
  figure.places = places;
}

SecondFigure both_ways(double first, double second, double bound, double v, const Vec3& point) {
  return {1, first, second, std::abs(first - second), bound, v, point};
}
/// Wrong only when the second is larger.
SecondFigure at_most(double first, double second, double bound, double v, const Vec3& point) {
  return {1, first, second, std::max(second - first, 0.0), bound, v, point};
}

/// What is measured at one place, and what the first path says of it where it says something.
struct Place {
  double v = 0.0;
  std::optional<double> first_gap, first_surface_gap, first_angle;
  Vec3 S, P;
  Tangents blend, primary;
  SecondSurface::Closest closest;
  double gap_bound = 0.0;
};

class SecondProbe {
 public:
  SecondProbe(const Seam& seam, const std::array<SecondSurface, 2>& surfaces)
      : seam_(seam), surfaces_(surfaces) {
    const Interval u = seam.blend.domain().u;
    u_ = seam.side == 0 ? u.lo : u.hi;
  }

  void measure(Place& at) const {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    at.S = surfaces_[0].point({u_, at.v});
    at.closest =
        surfaces_[1].closest ? surfaces_[1].closest(at.S) : SecondSurface::Closest{{nan, nan}, nan, nan};
    UV foot = at.closest.at;
    if (seam_.pcurve) {
      const Vec2 uv = seam_.pcurve->point(at.v);
      foot = {uv.x(), uv.y()};
    }
    at.P = surfaces_[1].point(foot);
    at.blend = tangents(seam_.blend, surfaces_[0], {u_, at.v});
    at.primary = tangents(*seam_.primary, surfaces_[1], foot);
    const double m = std::max(magnitude(seam_.blend, at.S), magnitude(*seam_.primary, at.P)) +
                     std::abs(foot.u) * at.primary.a.norm() + std::abs(foot.v) * at.primary.b.norm();
    at.gap_bound = roundings * eps * m;  // (4)
  }

 private:
  const Seam& seam_;
  const std::array<SecondSurface, 2>& surfaces_;
  double u_ = 0.0;
};

/// The places to look at, in order of the trimline: samples spread over it, and the worst of each figure.
std::vector<Place> places_of(const SeamReport& first, int count) {
  std::vector<Place> places;
  const std::size_t samples = first.v.size(), wanted = std::min(samples, static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < wanted; ++k) {
    const std::size_t i = (2 * k + 1) * samples / (2 * wanted);
    Place& p = places.emplace_back();
    p.v = first.v[i], p.first_gap = first.gap_at[i], p.first_angle = first.angle_at[i];
  }
  places.emplace_back().v = first.gap.v, places.back().first_gap = first.gap.worst;
  places.emplace_back().v = first.surface_gap.v, places.back().first_surface_gap = first.surface_gap.worst;
  places.emplace_back().v = first.angle.v, places.back().first_angle = first.angle.worst;
  return places;
}

}  // namespace

SecondSeam second_path(const Seam& seam, const SeamReport& first,
                       const std::array<SecondSurface, 2>& surfaces, int places) {
  SecondSeam result{first.name, {}, {}, {}};
  if (!seam.primary || !first.measured || first.samples == 0) return result;
  std::vector<Place> at = places_of(first, places);
  const SecondProbe probe(seam, surfaces);
  double length = 0.0, blend_area = 0.0, primary_area = 0.0;
  for (Place& p : at) {
    probe.measure(p);
    length = std::max(length, (p.S - at.front().S).norm());
    blend_area = std::max(blend_area, p.blend.a.norm() * p.blend.b.norm());
    primary_area = std::max(primary_area, p.primary.a.norm() * p.primary.b.norm());
  }
  for (const Place& p : at) {
    const double gap = seam.pcurve ? (p.S - p.P).norm() : p.closest.distance;               // (1)
    const double distance_bound = p.gap_bound + p.closest.slack + surfaces[1].uncertainty;  // (5)
    const double bound = seam.pcurve ? p.gap_bound : distance_bound;
    if (p.first_gap) compare(result.gap, both_ways(*p.first_gap, gap, bound, p.v, p.S));
    // The trimline is on the primary, so that nothing of the primary is further away than it.
    if (p.first_gap)
      compare(result.surface_gap, at_most(*p.first_gap, p.closest.distance, distance_bound, p.v, p.S));
    if (p.first_surface_gap) {
      const auto how = gap <= closed_part * length ? both_ways : at_most;
      compare(result.surface_gap,
              how(*p.first_surface_gap, p.closest.distance, distance_bound, p.v, p.S));  // (2)
    }
    const bool normals = p.blend.normal().norm() > vanishing * blend_area &&
                         p.primary.normal().norm() > vanishing * primary_area;
    if (p.first_angle && normals)
      compare(result.angle, both_ways(*p.first_angle, angle_between(p.blend.normal(), p.primary.normal()),
                                      p.blend.angle_error() + p.primary.angle_error(), p.v, p.S));
  }
  return result;
}

SecondClosing second_closing(const Surface& blend, const ClosingReport& first, const SecondSurface& surface) {
  SecondClosing result;
  const SurfaceDomain d = blend.domain();
  const double size = (surface.point({d.u.lo, d.v.lo}) - surface.point({d.u.hi, d.v.middle()})).norm();
  std::vector<double> u;
  for (int i = 0; i <= 8; ++i) u.push_back(d.u.at(i / 8.0));
  u.push_back(first.u);
  for (const double at : u) {
    const Vec3 a = surface.point({at, d.v.lo}), b = surface.point({at, d.v.hi});
    const bool place_of_gap = at == first.u && first.gap > 1e-9 * size,
               place_of_angle = at == first.u && !place_of_gap;
    compare(result.gap, (place_of_gap ? both_ways : at_most)(first.gap, (a - b).norm(),
                                                             roundings * eps * magnitude(blend, a), at, a));
    const Tangents lo = tangents(blend, surface, {at, d.v.lo}, false),
                   hi = tangents(blend, surface, {at, d.v.hi}, false);
    const double area = vanishing * std::max(lo.a.norm() * lo.b.norm(), hi.a.norm() * hi.b.norm());
    if (!(lo.normal().norm() > area) || !(hi.normal().norm() > area)) continue;
    compare(result.angle,
            (place_of_angle ? both_ways : at_most)(first.angle.value, angle_between(lo.normal(), hi.normal()),
                                                   lo.angle_error() + hi.angle_error(), at, a));
  }
  return result;
}

}  // namespace blendwright
