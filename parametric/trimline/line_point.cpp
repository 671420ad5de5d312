#include "parametric/trimline/line_point.hpp"

#include <cmath>

#include "kernel/base/number_text.hpp"

namespace blendwright {

Wrapped wrapped(const CurveDomain& domain, double v) {
  if (!domain.closed || domain.v.contains(v)) return {v, 0.0};
  const double length = domain.v.length();
  const double turns = std::floor((v - domain.v.lo) / length);
  return {domain.v.clamp(v - turns * length), turns};
}

LinePoint line_point(const Trimline& line, double v) {
  const CurveJet<2> p = line.pcurve().jet(wrapped(line.domain(), v).inside);
  const SurfaceJet s = line.primary().jet({p.C()[0], p.C()[1]});
  const double du = p.C1()[0], dv = p.C1()[1];
  LinePoint x;
  x.C = s.S;
  x.C1 = du * s.Su + dv * s.Sv;
  x.C2 = du * du * s.Suu + 2.0 * du * dv * s.Suv + dv * dv * s.Svv + p.C2()[0] * s.Su + p.C2()[1] * s.Sv;
  x.n = s.Su.cross(s.Sv);
  x.scale = s.Su.norm() + s.Sv.norm();
  x.reach = x.scale * p.C1().norm();
  return x;
}

std::string point_text(const Vec3& point) {
  std::string text("(");
  text.append(number_text(point[0], 6)).append(", ").append(number_text(point[1], 6));
  return text.append(", ").append(number_text(point[2], 6)).append(")");
}

std::string place(double v, const Vec3& point) {
  return "at v = " + number_text(v, 6) + " " + point_text(point);
}

}  // namespace blendwright
