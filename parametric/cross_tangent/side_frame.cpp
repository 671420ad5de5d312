#include "parametric/cross_tangent/side_frame.hpp"

#include <cmath>

#include "parametric/trimline/along_curve.hpp"

namespace blendwright {
namespace {

/// Within this part of the range of a harmless degenerate point, the frame is continued from here by its
/// second-order Taylor polynomial: error about h^3, rounding about eps / h^3 in the second derivative.
constexpr double reach = 1e-3;

/// The series about v0 + h from the one about v0; coefficients above order 2 are not known.
Series shifted(const Series& a, double h) {
  Series b;
  b.c[0] = a.c[0] + h * (a.c[1] + h * a.c[2]);
  b.c[1] = a.c[1] + 2.0 * h * a.c[2];
  b.c[2] = a.c[2];
  return b;
}
Series3 shifted(const Series3& a, double h) { return {shifted(a[0], h), shifted(a[1], h), shifted(a[2], h)}; }

}  // namespace

SideFrame::SideFrame(Trimline line, double sign, Radians psi, std::vector<double> harmless)
    : line_(std::move(line)),
      sign_(sign),
      cos_psi_(std::cos(psi.value)),
      sin_psi_(std::sin(psi.value)),
      harmless_(std::move(harmless)) {}

SideSeries SideFrame::regular(double v, bool with_bend) const {
  const Series2 uv = to_series<2>(line_.pcurve().jet(wrapped(line_.domain(), v).inside));
  const SurfacePartials P = line_.primary().partials({uv[0].value(), uv[1].value()});
  SideSeries s;
  const AlongCurve along_line(uv);
  s.C = along_line(P, 0, 0);
  const Series3 Pu = along_line(P, 1, 0), Pv = along_line(P, 0, 1);
  const Series3 N = cross(Pu, Pv);
  const Series over = inverse_sqrt(dot(N, N));
  s.normal = over * N;
  const Series3 C1 = differentiated(s.C);
  const Series3 tangent = inverse_sqrt(dot(C1, C1)) * C1;
  const Series3 k = cross(s.normal, tangent);
  s.direction = sign_ * cos_psi_ * k;
  if (sin_psi_ != 0.0) s.direction = s.direction + sin_psi_ * tangent;
  if (!with_bend) return s;
  // direction = a Pu + b Pv;  a = direction.(Pv x n)/|Pu x Pv|,  b = direction.(n x Pu)/|Pu x Pv|.
  const Series a = over * dot(s.direction, cross(Pv, s.normal)),
               b = over * dot(s.direction, cross(s.normal, Pu));
  const Series L = dot(along_line(P, 2, 0), s.normal), M = dot(along_line(P, 1, 1), s.normal),
               Nn = dot(along_line(P, 0, 2), s.normal);
  s.bend = a * a * L + 2.0 * a * b * M + b * b * Nn;
  return s;
}

const double* SideFrame::harmless_near(double v) const {
  const CurveDomain domain = line_.domain();
  const double length = domain.v.length();
  for (const double& h : harmless_) {
    double away = v - h;
    if (domain.closed) away -= length * std::round(away / length);
    if (std::abs(away) < reach * length) return &h;
  }
  return nullptr;
}

SideSeries SideFrame::evaluated(double v, bool with_bend) const {
  const double* h = harmless_near(v);
  if (h == nullptr) return regular(v, with_bend);
  const CurveDomain domain = line_.domain();
  const double length = domain.v.length();
  double away = v - *h;
  if (domain.closed) away -= length * std::round(away / length);
  double side = away < 0.0 ? -1.0 : 1.0;
  if (!domain.closed && !domain.v.contains(*h + side * reach * length)) side = -side;
  const double step = away - side * reach * length;
  SideSeries s = regular(*h + side * reach * length, with_bend);
  return {position(v), normalized(shifted(s.direction, step)), normalized(shifted(s.normal, step)),
          shifted(s.bend, step)};
}

SideSeries SideFrame::first_order(double v) const { return evaluated(v, false); }
SideSeries SideFrame::second_order(double v) const { return evaluated(v, true); }

Vec3 SideFrame::direction(double v, const LinePoint& point) const {
  if (harmless_near(v) != nullptr) return derivative(first_order(v).direction, 0);
  const Vec3 tangent = point.C1.normalized();
  return sign_ * cos_psi_ * point.n.normalized().cross(tangent) + sin_psi_ * tangent;
}

}  // namespace blendwright
