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

namespace {

using Jets = std::array<ModelJet, 3>;

/// Value and first derivative along v as jets; and half of the second where there is one.
Jets jets_of(const ModelVector& f, const ModelVector& f1, const ModelVector& f2 = {}) {
  Jets j;
  for (std::size_t d = 0; d < 3; ++d) {
    j[d].c[0] = f[d];
    j[d].c[1] = f1[d];
    j[d].c[3] = 0.5 * f2[d];
  }
  return j;
}
ModelJet dot(const Jets& a, const Jets& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Jets cross(const Jets& a, const Jets& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Jets operator*(const ModelJet& s, const Jets& a) { return {s * a[0], s * a[1], s * a[2]}; }
Jets normalized(const Jets& a) { return pow(dot(a, a), -0.5) * a; }
ModelVector value(const Jets& a) { return {a[0].c[0], a[1].c[0], a[2].c[0]}; }

}  // namespace

SideEnclosure SideFrame::enclosed(const TaylorModel& v) const {
  const CurveDomain domain = line_.domain();
  SideEnclosure s;
  if (!harmless_.empty()) {
    s.unproven = "the cross tangent is continued over a degenerate point of the trimline";
    return s;
  }
  CurveEnclosure uv;
  SurfaceEnclosure P;
  const TaylorModel inside = inside_range(v, domain.v.lo, domain.v.hi, domain.closed);
  if (!line_.pcurve().enclose(inside, uv)) s.unproven = "the trimline's curve has no enclosure";
  if (!line_.primary().enclose(uv.D[0][0], uv.D[0][1], P)) s.unproven = "the primary has no enclosure";
  for (const std::string* why : {&uv.unproven, &P.unproven})
    if (!why->empty()) s.unproven = *why;
  if (!s.unproven.empty()) return s;
  const TaylorModel &u1 = uv.D[1][0], &v1 = uv.D[1][1];
  const ModelVector C1 = velocity(P, uv), C2 = acceleration(P, uv);
  const Jets Pu = jets_of(P.Su, u1 * P.Suu + v1 * P.Suv), Pv = jets_of(P.Sv, u1 * P.Suv + v1 * P.Svv);
  s.C = jets_of(P.S, C1, C2);
  const Jets N = cross(Pu, Pv), tangent = normalized(jets_of(C1, C2));
  const ModelJet over = pow(dot(N, N), -0.5);
  s.normal = over * N;
  s.direction = ModelJet(sign_ * cos_psi_) * cross(s.normal, tangent);
  if (sin_psi_ != 0.0)
    for (std::size_t d = 0; d < 3; ++d) s.direction[d] = s.direction[d] + sin_psi_ * tangent[d];
  const ModelVector n = value(s.normal), t = value(s.direction);
  const TaylorModel a = over.c[0] * blendwright::dot(t, blendwright::cross(P.Sv, n)),
                    b = over.c[0] * blendwright::dot(t, blendwright::cross(n, P.Su));
  s.bend = a * a * blendwright::dot(P.Suu, n) + 2.0 * (a * b * blendwright::dot(P.Suv, n)) +
           b * b * blendwright::dot(P.Svv, n);
  return s;
}

Vec3 SideFrame::direction(double v, const LinePoint& point) const {
  if (harmless_near(v) != nullptr) return derivative(first_order(v).direction, 0);
  const Vec3 tangent = point.C1.normalized();
  return sign_ * cos_psi_ * point.n.normalized().cross(tangent) + sin_psi_ * tangent;
}

}  // namespace blendwright
