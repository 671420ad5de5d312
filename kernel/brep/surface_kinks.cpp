#include "kernel/brep/surface_kinks.hpp"

#include <Geom_BSplineSurface.hxx>
#include <algorithm>
#include <cmath>

namespace blendwright::detail {
namespace {

using opencascade::handle;

/// Knots of one direction where the spline is not smooth, and the period (0: none).
struct Knots {
  std::vector<double> at;
  double period = 0.0, length = 1.0;
};

Knots knots(const handle<Geom_BSplineSurface>& s, int d) {
  constexpr int smooth = 3;  // derivatives that curvature and its change along the line need
  Knots k;
  const int count = d == 0 ? s->NbUKnots() : s->NbVKnots(), degree = d == 0 ? s->UDegree() : s->VDegree();
  const auto at = [&](int i) { return d == 0 ? s->UKnot(i) : s->VKnot(i); };
  const bool periodic = d == 0 ? s->IsUPeriodic() : s->IsVPeriodic();
  k.length = at(count) - at(1);
  if (periodic) k.period = k.length;
  for (int i = periodic ? 1 : 2; i < count; ++i)
    if (degree - (d == 0 ? s->UMultiplicity(i) : s->VMultiplicity(i)) < smooth) k.at.push_back(at(i));
  return k;
}

/// Signed distance to the image of a knot that is nearest to `near`.
double off(const Knots& k, double knot, double x, double near) {
  if (k.period > 0.0) knot += k.period * std::round((near - knot) / k.period);
  return x - knot;
}

}  // namespace

std::vector<double> surface_kinks(const handle<Geom_Surface>& surface,
                                  const std::function<Vec2(double)>& curve, const Interval& range) {
  std::vector<double> found;
  const auto spline = handle<Geom_BSplineSurface>::DownCast(surface);
  if (spline.IsNull()) return found;
  constexpr int steps = 256;
  std::vector<Vec2> points;
  for (int i = 0; i <= steps; ++i) points.push_back(curve(range.at(static_cast<double>(i) / steps)));
  for (const int d : {0, 1}) {
    const Knots k = knots(spline, d);
    for (const double knot : k.at)
      for (std::size_t i = 0; i < steps; ++i) {
        const double near = points[i][d], b = off(k, knot, points[i + 1][d], near);
        const double a = off(k, knot, near, near);
        // A line along the knot wavers about it by rounding: no crossing.
        if ((a > 0.0) == (b > 0.0) || std::abs(b - a) < 1e-9 * k.length) continue;
        double lo = range.at(static_cast<double>(i) / steps),
               hi = range.at((static_cast<double>(i) + 1.0) / steps);
        for (int n = 0; n < 60; ++n) {
          const double middle = 0.5 * (lo + hi);
          ((off(k, knot, curve(middle)[d], near) > 0.0) == (a > 0.0) ? lo : hi) = middle;
        }
        found.push_back(0.5 * (lo + hi));
      }
  }
  std::sort(found.begin(), found.end());
  std::vector<double> apart;
  const double least = 1e-6 * range.length();
  for (const double v : found)
    if (v > range.lo + least && v < range.hi - least && (apart.empty() || v > apart.back() + least))
      apart.push_back(v);
  return apart;
}

bool on_surface_kink(const handle<Geom_Surface>& surface, const Vec2& uv) {
  const auto spline = handle<Geom_BSplineSurface>::DownCast(surface);
  if (spline.IsNull()) return false;
  for (const int d : {0, 1}) {
    const Knots k = knots(spline, d);
    for (const double knot : k.at)
      if (std::abs(off(k, knot, uv[d], uv[d])) <= 1e-9 * k.length) return true;
  }
  return false;
}

}  // namespace blendwright::detail
