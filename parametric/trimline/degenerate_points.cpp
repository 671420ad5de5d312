#include <algorithm>
#include <cmath>
#include <numbers>

#include "parametric/trimline/line_point.hpp"
#include "parametric/trimline/trimline.hpp"
#include "parametric/trimline/zero_scan.hpp"

namespace blendwright {
namespace {

/// Limits are taken this part of the range away from the point: n'' h^2 < 1e-8 and |Su x Sv| ~ h keeps 10
/// digits.
constexpr double limit_step = 1e-5;

double angle(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

DegeneratePoint judged(const Trimline& line, DegeneratePoint::Kind kind, double v) {
  const CurveDomain domain = line.domain();
  const double h = limit_step * domain.v.length();
  DegeneratePoint point{kind, v, line_point(line, v).C, 0.0, 0.0};
  if (!domain.closed && (v - 2.0 * h < domain.v.lo || v + 2.0 * h > domain.v.hi)) return point;
  // Two steps on each side, extrapolated linearly to the point.
  const auto limit = [&](double step, auto direction) {
    const Vec3 near = direction(line_point(line, v + step)),
               far = direction(line_point(line, v + 2.0 * step));
    return Vec3(2.0 * near - far);
  };
  const auto normal = [](const LinePoint& p) { return Vec3(p.n.normalized()); };
  const auto tangent = [](const LinePoint& p) { return Vec3(p.C1.normalized()); };
  point.normal_turn = angle(limit(-h, normal), limit(h, normal));
  point.tangent_turn = angle(limit(-h, tangent), limit(h, tangent));
  return point;
}

}  // namespace

std::vector<DegeneratePoint> degenerate_points(const Trimline& line) {
  const CurveDomain domain = line.domain();
  std::vector<double> speed, area;
  double speeds = 0.0, areas = 0.0, reaches = 0.0, squares = 0.0;
  for (const double v : zero_scan_places(domain)) {
    const LinePoint p = line_point(line, v);
    speed.push_back(p.C1.norm());
    area.push_back(p.n.norm());
    speeds += speed.back();
    areas += area.back();
    reaches += p.reach;
    squares += p.scale * p.scale;
  }
  if (areas <= 1e-12 * squares || speeds <= 1e-12 * reaches) {
    const auto kind = areas <= 1e-12 * squares ? DegeneratePoint::Kind::pole : DegeneratePoint::Kind::cusp;
    const double none = std::numbers::pi;
    return {{kind, domain.v.lo, line_point(line, domain.v.lo).C, none, none}};
  }
  std::vector<DegeneratePoint> points;
  const auto speed_at = [&line](double v) { return line_point(line, v).C1.norm(); };
  const auto area_at = [&line](double v) { return line_point(line, v).n.norm(); };
  for (const double v : zeros(domain, speed, speed_at))
    points.push_back(judged(line, DegeneratePoint::Kind::cusp, v));
  for (const double v : zeros(domain, area, area_at))
    points.push_back(judged(line, DegeneratePoint::Kind::pole, v));
  std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.v < b.v; });
  return points;
}

}  // namespace blendwright
