#pragma once
// Primaries and trimlines that the tests of this folder share.
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "kernel/geometry/formula_surface.hpp"
#include "kernel/primitives/primary.hpp"
#include "parametric/trimline/trimline.hpp"

namespace blendwright::test {

inline constexpr double pi = std::numbers::pi;

inline Surface primary_of(PrimarySpec spec, const RigidMotion& placement = {}) {
  spec.placement = placement;
  return make_primary(spec);
}
inline Surface cylinder(double radius, double lo, double hi, const RigidMotion& placement = {}) {
  PrimarySpec spec;
  spec.kind = "cylinder";
  spec.numbers = {{"radius", radius}};
  spec.u = Interval{lo, hi};
  return primary_of(spec, placement);
}
inline Surface plane(double half, const RigidMotion& placement = {}) {
  PrimarySpec spec;
  spec.kind = "plane";
  spec.u = spec.v = Interval{-half, half};
  return primary_of(spec, placement);
}
inline Surface formula(std::vector<std::string> S, Interval u, Interval v,
                       std::array<bool, 2> closed = {false, false}) {
  PrimarySpec spec;
  spec.kind = "formula";
  spec.formulas = std::move(S);
  spec.u = u;
  spec.v = v;
  spec.closed = closed;
  return make_primary(spec);
}
inline Surface torus(double R, double r) {
  return formula({"(" + std::to_string(R) + " + " + std::to_string(r) + "*cos(u))*cos(v)",
                  "(" + std::to_string(R) + " + " + std::to_string(r) + "*cos(u))*sin(v)",
                  std::to_string(r) + "*sin(u)"},
                 {0.0, 2.0 * pi}, {0.0, 2.0 * pi}, {true, true});
}
inline Surface sphere(double radius) {
  PrimarySpec spec;
  spec.kind = "sphere";
  spec.numbers = {{"radius", radius}};
  return make_primary(spec);
}

/// A curve of Dim formulas: F has  template <class T> std::array<T, Dim> operator()(const T& v) const.
template <int Dim, class F>
struct CurveOf {
  std::shared_ptr<const F> f;  // a lambda that captures cannot be assigned, a curve must be
  CurveDomain range;
  template <class T>
  std::array<T, static_cast<std::size_t>(Dim)> operator()(const T& v) const {
    return (*f)(v);
  }
  [[nodiscard]] CurveDomain domain() const { return range; }
};
template <int Dim, class F>
Curve<Dim> curve(F f, Interval range, bool closed = false) {
  return FormulaCurve<CurveOf<Dim, F>, Dim>(
      CurveOf<Dim, F>{std::make_shared<const F>(std::move(f)), {range, closed}});
}

/// (a cos v, b sin v) about (x, y): an ellipse in the plane's parameters.
inline Curve2 ellipse(double a, double b, double x = 0.0, double y = 0.0) {
  return curve<2>(
      [=](const auto& v) {
        return std::array{x + a * cos(v), y + b * sin(v)};
      },
      {0.0, 2.0 * pi}, true);
}

/// Derivative by the central difference of fourth order: error h^4/30 f^(5) + about 2 eps |f| / h.
template <class F>
auto difference(F f, double v, double h) {
  return ((8.0 * (f(v + h) - f(v - h)) - (f(v + 2.0 * h) - f(v - 2.0 * h))) / (12.0 * h)).eval();
}

inline std::string message_of(const auto& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace blendwright::test
