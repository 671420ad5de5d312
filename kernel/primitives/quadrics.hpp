#pragma once
// The elementary surfaces, in local coordinates and with their numbers public, so that an exporter can
// recognise them:
//     if (const auto* c = surface.target<Cylinder>()) ... c->shape().radius
// u runs along the profile, v is the angle about the z axis (radians); lengths in model units.
#include <array>
#include <cmath>

#include "kernel/geometry/formula_surface.hpp"

namespace blendwright {

/// What every shape holds: its domain. A direction that turns is closed when its range is 2 pi.
struct ShapeDomain {
  SurfaceDomain range;
  [[nodiscard]] const SurfaceDomain& domain() const { return range; }
};

/// (u, v, 0)
struct PlaneShape : ShapeDomain {
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    return {u, v, T(0.0)};
  }
};

/// (r cos v, r sin v, u),  r = radius > 0
struct CylinderShape : ShapeDomain {
  double radius = 1.0;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const auto [sin_v, cos_v] = sin_cos(v);
    return {radius * cos_v, radius * sin_v, u};
  }
};

/// (a cos v, b sin v, u)
struct EllipticCylinderShape : ShapeDomain {
  double a = 1.0, b = 1.0;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const auto [sin_v, cos_v] = sin_cos(v);
    return {a * cos_v, b * sin_v, u};
  }
};

/// ((r + u sin al) cos v, (r + u sin al) sin v, u cos al): u is the slant length from the circle of radius r,
/// al = half_angle in (0, pi/2).
struct ConeShape : ShapeDomain {
  double radius = 1.0;
  Radians half_angle = degrees(45.0);
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const auto [sin_v, cos_v] = sin_cos(v);
    const T rho = radius + u * std::sin(half_angle.value);
    return {rho * cos_v, rho * sin_v, u * std::cos(half_angle.value)};
  }
};

/// (a u cos v, b u sin v, h u): apex at u = 0, ellipse with semi-axes a, b at the height h (of either sign).
struct EllipticConeShape : ShapeDomain {
  double a = 1.0, b = 1.0, height = 1.0;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const auto [sin_v, cos_v] = sin_cos(v);
    return {a * u * cos_v, b * u * sin_v, height * u};
  }
};

/// (R u cos v, R u v sin v, h u): a cone over the curve (cos v, v sin v), which never closes.
struct IrregularConeShape : ShapeDomain {
  double radius = 1.0, height = 1.0;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const auto [sin_v, cos_v] = sin_cos(v);
    return {radius * u * cos_v, radius * u * (v * sin_v), height * u};
  }
};

/// (r cos u cos v, r cos u sin v, r sin u): u is the latitude in [-pi/2, pi/2].
struct SphereShape : ShapeDomain {
  double radius = 1.0;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const auto [sin_u, cos_u] = sin_cos(u);
    const auto [sin_v, cos_v] = sin_cos(v);
    const T rho = radius * cos_u;
    return {rho * cos_v, rho * sin_v, radius * sin_u};
  }
};

/// (a cos u cos v, b cos u sin v, c sin u): u in [-pi/2, pi/2].
struct EllipsoidShape : ShapeDomain {
  double a = 1.0, b = 1.0, c = 1.0;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const auto [sin_u, cos_u] = sin_cos(u);
    const auto [sin_v, cos_v] = sin_cos(v);
    return {a * cos_u * cos_v, b * cos_u * sin_v, c * sin_u};
  }
};

/// ((R + r cos u) cos v, (R + r cos u) sin v, r sin u): R = major_radius > r = minor_radius, u turns about
/// the tube.
struct TorusShape : ShapeDomain {
  double major_radius = 2.0, minor_radius = 1.0;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const auto [sin_u, cos_u] = sin_cos(u);
    const auto [sin_v, cos_v] = sin_cos(v);
    const T rho = major_radius + minor_radius * cos_u;
    return {rho * cos_v, rho * sin_v, minor_radius * sin_u};
  }
};

/// (a u cos v, b u sin v, c u^2): c of either sign.
struct EllipticParaboloidShape : ShapeDomain {
  double a = 1.0, b = 1.0, c = 1.0;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const auto [sin_v, cos_v] = sin_cos(v);
    return {a * u * cos_v, b * u * sin_v, c * (u * u)};
  }
};

/// (a cosh u cos v, b cosh u sin v, c sinh u)
struct HyperboloidOneSheetShape : ShapeDomain {
  double a = 1.0, b = 1.0, c = 1.0;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    using std::cosh, std::sinh;
    const auto [sin_v, cos_v] = sin_cos(v);
    const T ch = cosh(u);
    return {a * ch * cos_v, b * ch * sin_v, c * sinh(u)};
  }
};

/// (a sinh u cos v, b sinh u sin v, c cosh u): the sheet on the side of c, which may be negative.
struct HyperboloidTwoSheetsShape : ShapeDomain {
  double a = 1.0, b = 1.0, c = 1.0;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    using std::cosh, std::sinh;
    const auto [sin_v, cos_v] = sin_cos(v);
    const T sh = sinh(u);
    return {a * sh * cos_v, b * sh * sin_v, c * cosh(u)};
  }
};

using Plane = FormulaSurface<PlaneShape>;
using Cylinder = FormulaSurface<CylinderShape>;
using EllipticCylinder = FormulaSurface<EllipticCylinderShape>;
using Cone = FormulaSurface<ConeShape>;
using EllipticCone = FormulaSurface<EllipticConeShape>;
using IrregularCone = FormulaSurface<IrregularConeShape>;
using Sphere = FormulaSurface<SphereShape>;
using Ellipsoid = FormulaSurface<EllipsoidShape>;
using Torus = FormulaSurface<TorusShape>;
using EllipticParaboloid = FormulaSurface<EllipticParaboloidShape>;
using HyperboloidOneSheet = FormulaSurface<HyperboloidOneSheetShape>;
using HyperboloidTwoSheets = FormulaSurface<HyperboloidTwoSheetsShape>;

}  // namespace blendwright
