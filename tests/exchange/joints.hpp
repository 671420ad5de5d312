#pragma once
// Joints whose geometry is known in closed form: input of the B-rep tests. Blends are ruled between two
// trimlines.
#include <cmath>
#include <numbers>

#include "kernel/brep/shape.hpp"
#include "kernel/geometry/formula_surface.hpp"
#include "kernel/geometry/rigid_motion.hpp"
#include "kernel/geometry/series.hpp"
#include "kernel/geometry/spline_interpolation.hpp"
#include "kernel/primitives/quadrics.hpp"

namespace blendwright::test {

inline constexpr double pi = std::numbers::pi;
inline const CurveDomain whole_turn{{0.0, 2.0 * pi}, true};

/// start + (v - lo) rate
struct LineShape {
  Vec2 start, rate;
  CurveDomain range;
  template <class T>
  std::array<T, 2> operator()(const T& v) const {
    return {start.x() + rate.x() * (v - range.v.lo), start.y() + rate.y() * (v - range.v.lo)};
  }
  [[nodiscard]] CurveDomain domain() const { return range; }
};
inline Curve2 line(Vec2 start, Vec2 rate, CurveDomain range = whole_turn) {
  return FormulaCurve<LineShape, 2>(LineShape{start, rate, range});
}

/// centre + radius (cos v, sin v), run through over `range`
struct CircleShape {
  Vec2 centre;
  double radius = 1.0;
  CurveDomain range = whole_turn;
  template <class T>
  std::array<T, 2> operator()(const T& v) const {
    using std::cos, std::sin;
    return {centre.x() + radius * cos(v), centre.y() + radius * sin(v)};
  }
  [[nodiscard]] CurveDomain domain() const { return range; }
};
inline Curve2 circle(Vec2 centre, double radius, CurveDomain range = whole_turn) {
  return FormulaCurve<CircleShape, 2>(CircleShape{centre, radius, range});
}

/// (base + amplitude cos(n v), start + v): a wave around a surface that closes in its second parameter.
struct WaveShape {
  double base = 0.0, amplitude = 0.3, n = 2.0, start = 0.0;
  CurveDomain range = whole_turn;
  template <class T>
  std::array<T, 2> operator()(const T& v) const {
    using std::cos;
    return {base + amplitude * cos(n * v), start + v};
  }
  [[nodiscard]] CurveDomain domain() const { return range; }
};
inline Curve2 wave(double base, double amplitude, double n, double start = 0.0) {
  return FormulaCurve<WaveShape, 2>(WaveShape{base, amplitude, n, start});
}

/// (1 - u) C0(v) + u C1(v)
struct RuledSurface {
  Surface s0, s1;
  Curve2 c0, c1;
  [[nodiscard]] SurfacePartials partials(UV p) const {
    const auto at = [&](const Surface& s, const Curve2& c) {
      const CurveJet<2> j = c.jet(p.v);
      return along(s.partials({j.C().x(), j.C().y()}), 0, 0, to_series<2>(j));
    };
    const Series3 a = at(s0, c0), b = at(s1, c1);
    SurfacePartials P;
    for (Vec3& d : P.d) d.setZero();
    for (int k = 0; k <= 3; ++k) {
      P(0, k) = (1.0 - p.u) * derivative(a, k) + p.u * derivative(b, k);
      P(1, k) = derivative(b, k) - derivative(a, k);
    }
    return P;
  }
  [[nodiscard]] SurfaceJet jet(UV p) const {
    const SurfacePartials P = partials(p);
    return {P(0, 0), P(1, 0), P(0, 1), P(2, 0), P(1, 1), P(0, 2)};
  }
  [[nodiscard]] SurfaceDomain domain() const {
    return {{0.0, 1.0}, c0.domain().v, false, c0.domain().closed && c1.domain().closed};
  }
};

struct Side {
  std::string name;
  Surface surface;
  Curve2 pcurve;
  bool kept_left = true;
};

/// One ruled blend between two primaries, fitted to 1e-8.
inline Assembly joint(const Side& from, const Side& to) {
  const Surface ruled = RuledSurface{from.surface, to.surface, from.pcurve, to.pcurve};
  Assembly a;
  a.blends.push_back({"blend", fit_surface(ruled, {.tolerance = 1e-8}).surface, {}});
  for (const int side : {0, 1}) {
    const Side& s = side == 0 ? from : to;
    a.primaries.push_back({s.name, s.surface, {{s.pcurve, s.kept_left, 0, side}}, {}});
  }
  return a;
}

inline Surface cylinder(double radius, Interval length, Interval angle = {0.0, 2.0 * pi}) {
  CylinderShape c;
  c.radius = radius;
  c.range = {length, angle, false, angle.length() >= 2.0 * pi - 1e-12};
  return Cylinder(c);
}
inline Surface plane(Interval u, Interval v) {
  PlaneShape p;
  p.range = {u, v, false, false};
  return Plane(p);
}
inline Surface sphere(double radius) {
  SphereShape s;
  s.radius = radius;
  s.range = {{-0.5 * pi, 0.5 * pi}, {0.0, 2.0 * pi}, false, true};
  return Sphere(s);
}
inline Surface ellipsoid(double a, double b, double c) {
  EllipsoidShape s;
  s.a = a;
  s.b = b;
  s.c = c;
  s.range = {{-0.5 * pi, 0.5 * pi}, {0.0, 2.0 * pi}, false, true};
  return Ellipsoid(s);
}
inline Surface torus(double major, double minor) {
  TorusShape t;
  t.major_radius = major;
  t.minor_radius = minor;
  t.range = {{0.0, 2.0 * pi}, {0.0, 2.0 * pi}, true, true};
  return Torus(t);
}
inline Surface moved(const Surface& s, const Vec3& by) {
  return placed(s, {Eigen::Matrix3d::Identity(), by});
}

/// Cylinders of radius 1 (kept above z = 5) and 2 (kept below z = 3) about the z axis, joined by a cone. The
/// trimlines start at the angle `phase`. Su x Sv points inwards there, so left of a line of growing angle is
/// the side of smaller u.
inline Assembly coaxial(double phase = 0.0) {
  return joint({"upper", cylinder(1.0, {4.0, 9.0}), line({5.0, phase}, {0.0, 1.0}), false},
               {"lower", cylinder(2.0, {-2.0, 4.0}), line({3.0, phase}, {0.0, 1.0}), true});
}
/// Area of coaxial(): two cylinders and the frustum of radii 1, 2 and height 2.
inline const double coaxial_area = 2.0 * pi * 4.0 + 4.0 * pi * 5.0 + pi * 3.0 * std::sqrt(5.0);

}  // namespace blendwright::test
