#pragma once
// Surfaces made of a profile: revolution and extrusion, and the surface that is typed as three formulas.
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "kernel/geometry/bspline.hpp"
#include "kernel/geometry/formula_surface.hpp"
#include "kernel/math/formula.hpp"
#include "kernel/primitives/quadrics.hpp"

namespace blendwright {

/// A parameter of a closed direction, brought into its range by whole periods: a typed formula need not be
/// periodic.
template <class T>
T in_period(const T& t, const Interval& range, bool closed) {
  if constexpr (std::same_as<T, ModelJet>) {
    return closed ? in_closed_range(t, range.lo, range.hi) : t;
  } else {
    double value = 0.0;
    if constexpr (TaylorSeries<T>)
      value = t.value();
    else
      value = t;
    if (!closed || range.contains(value)) return t;
    return t - range.length() * std::floor((value - range.lo) / range.length());
  }
}

/// A curve of one formula per coordinate, each in one variable.
template <std::size_t Dim>
struct FormulaProfile {
  std::vector<Formula> coordinates;  ///< Dim of them
  template <class T>
  std::array<T, Dim> operator()(const T& t) const {
    std::array<T, Dim> p;
    for (std::size_t d = 0; d < Dim; ++d) p[d] = coordinates[d](std::span<const T>(&t, 1));
    return p;
  }
};

/// A B-spline curve, exact to the order of the series.
template <std::size_t Dim>
struct SplineProfile {
  BSplineCurve<static_cast<int>(Dim)> curve;
  template <class T>
  std::array<T, Dim> operator()(const T& t) const {
    std::array<T, Dim> p;
    if constexpr (std::same_as<T, ModelJet>) {
      CurveEnclosure c;
      curve.enclose(t.c[0], c);
      for (std::size_t d = 0; d < Dim; ++d) p[d] = composed(c.D[0][d], c.D[1][d], 0.5 * c.D[2][d], t);
      return p;
    } else {
      fill_series(t, p);
      return p;
    }
  }

 private:
  template <class T>
  void fill_series(const T& t, std::array<T, Dim>& p) const {
    const BSplineBasis& basis = curve.basis();
    const BSplineBasis::Local local = basis.evaluate(t.value(), T::order);
    for (std::size_t d = 0; d < Dim; ++d) {
      std::array<double, T::order + 1> f{};  // f^(k) / k!
      double factorial = 1.0;
      for (std::size_t k = 0; k < f.size(); ++k) {
        if (k > 1) factorial *= static_cast<double>(k);
        for (int i = 0; i <= basis.degree(); ++i) {
          const auto control = static_cast<std::size_t>(basis.index(local.first + i));
          f[k] += local.value[k][static_cast<std::size_t>(i)] *
                  curve.control()[control][static_cast<Eigen::Index>(d)];
        }
        f[k] /= factorial;
      }
      p[d] = compose_scalar(f, t);
    }
  }
};

/// (r(u) cos v, r(u) sin v, z(u)) for a profile u -> (r, z).
template <class Profile>
struct RevolutionShape : ShapeDomain {
  Profile profile;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const auto [sin_v, cos_v] = sin_cos(v);
    const auto [r, z] = profile(in_period(u, range.u, range.u_closed));
    return {r * cos_v, r * sin_v, z};
  }
};

/// c(v) + u d for a profile v -> c and a unit vector d.
template <class Profile>
struct ExtrusionShape : ShapeDomain {
  Profile profile;
  Vec3 direction = Vec3::UnitZ();
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const auto c = profile(in_period(v, range.v, range.v_closed));
    return {c[0] + u * direction[0], c[1] + u * direction[1], c[2] + u * direction[2]};
  }
};

/// Three formulas in u and v.
struct TypedShape : ShapeDomain {
  std::vector<Formula> coordinates;
  template <class T>
  std::array<T, 3> operator()(const T& u, const T& v) const {
    const std::array<T, 2> uv{in_period(u, range.u, range.u_closed), in_period(v, range.v, range.v_closed)};
    const std::span<const T> arguments(uv);
    return {coordinates[0](arguments), coordinates[1](arguments), coordinates[2](arguments)};
  }
};

using TypedSurface = FormulaSurface<TypedShape>;
using RevolvedFormulas = FormulaSurface<RevolutionShape<FormulaProfile<2>>>;
using RevolvedSpline = FormulaSurface<RevolutionShape<SplineProfile<2>>>;
using ExtrudedFormulas = FormulaSurface<ExtrusionShape<FormulaProfile<3>>>;
using ExtrudedSpline = FormulaSurface<ExtrusionShape<SplineProfile<3>>>;

}  // namespace blendwright
