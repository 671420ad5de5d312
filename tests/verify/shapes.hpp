#pragma once
// Surfaces and trimlines typed as formulas, and the joints that several tests measure.
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "kernel/base/error.hpp"
#include "kernel/geometry/formula_surface.hpp"
#include "kernel/geometry/rigid_motion.hpp"
#include "tests/support/for_all.hpp"
#include "verify/continuity/seam.hpp"

namespace blendwright::test {

constexpr double pi = std::numbers::pi;

/// Captures make a lambda uncopyable by assignment; shapes must be copyable.
template <class F>
struct SurfaceShape {
  std::shared_ptr<const F> f;
  SurfaceDomain d;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    return (*f)(u, v);
  }
  [[nodiscard]] SurfaceDomain domain() const { return d; }
};
/// Jets are all that verify may ask for; without the fourth-order partials the tests compile in half the
/// time.
template <class Shape>
struct JetsOnly {
  FormulaSurface<Shape> formula;
  [[nodiscard]] SurfaceJet jet(UV p) const { return formula.jet(p); }
  [[nodiscard]] SurfacePartials partials(UV) const { throw GeometryError("verify works on jets alone"); }
  [[nodiscard]] SurfaceDomain domain() const { return formula.domain(); }
};
/// `f(u, v)` returns std::array<T, 3> for any number type T.
template <class F>
Surface surface(SurfaceDomain d, F f) {
  using Shape = SurfaceShape<F>;
  return JetsOnly<Shape>{Shape{std::make_shared<const F>(std::move(f)), d}};
}

template <class F>
struct CurveShape {
  std::shared_ptr<const F> f;
  CurveDomain d;
  template <class T>
  std::array<T, 2> operator()(const T& v) const {
    return (*f)(v);
  }
  [[nodiscard]] CurveDomain domain() const { return d; }
};
template <class F>
Curve2 parameter_curve(CurveDomain d, F f) {
  using Shape = CurveShape<F>;
  return FormulaCurve<Shape, 2>(Shape{std::make_shared<const F>(std::move(f)), d});
}

/// The line u = constant of a surface, v its own.
inline Curve2 isoline_u(double u, CurveDomain d) {
  return parameter_curve(d, [u](const auto& v) {
    using T = std::remove_cvref_t<decltype(v)>;
    return std::array<T, 2>{T(u), v};
  });
}

inline const SurfaceDomain turn{{0.0, 1.0}, {0.0, 2.0 * pi}, false, true};
inline const CurveDomain turn_line{{0.0, 2.0 * pi}, true};

/// Surface of revolution about z; `r` and `z` are functions of u.
template <class R, class Z>
Surface revolution(SurfaceDomain d, R r, Z z) {
  return surface(d, [r, z](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{T(r(u)) * cos(v), T(r(u)) * sin(v), T(z(u))};
  });
}

/// Radius 1, z = u in [0, 1]; its normal Su x Sv points to the axis, and the kept part lies below the line u
/// = 1, which is to the left.
inline Surface unit_cylinder() {
  return revolution(
      turn, [](const auto&) { return 1.0; }, [](const auto& u) { return u; });
}

/// Joint of the unit cylinder at z = 1 with a blend of revolution that starts there.
inline Seam on_cylinder(const Surface& blend) {
  return {"test/from", blend, 0, unit_cylinder(), isoline_u(1.0, turn_line), true};
}

/// The same cylinder, continued from z = 1 to z = 3.
inline Surface continued_cylinder() {
  return revolution(
      turn, [](const auto&) { return 1.0; }, [](const auto& u) { return 1.0 + 2.0 * u; });
}

/// Leaves the cylinder along an arc of radius rho: a quarter of a torus.
inline Surface flare(double rho) {
  return revolution(
      turn, [rho](const auto& u) { return 1.0 + rho * (1.0 - cos(0.5 * pi * u)); },
      [rho](const auto& u) { return 1.0 + rho * sin(0.5 * pi * u); });
}

/// z = 0, [-2, 2] squared.
inline Surface plane_patch() {
  return surface({{-2.0, 2.0}, {-2.0, 2.0}, false, false}, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{u, v, T(0.0)};
  });
}

/// Leaves the plane z = 0 at x = 0 with height f(x), u = x in [0, 1], v = y in [-1, 1].
template <class F>
Surface ramp(F f) {
  return surface({{0.0, 1.0}, {-1.0, 1.0}, false, false}, [f](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{u, v, T(f(u))};
  });
}
/// The kept part is x < 0; nP = z and C' = y, so n x C' = -x: to the left.
inline Seam on_plane(const Surface& blend) {
  return {"test/from", blend, 0, plane_patch(), isoline_u(0.0, {{-1.0, 1.0}, false}), true};
}

inline RigidMotion random_motion(Rng& rng) {
  const auto vector = [&] { return Vec3(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1)); };
  return RigidMotion::from_axis(5.0 * vector(), vector() + Vec3(0, 0, 2), Vec3(1, 0, 0) + 0.5 * vector());
}

}  // namespace blendwright::test
