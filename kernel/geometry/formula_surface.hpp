#pragma once
// Surfaces and curves given by templates over the number type: one body, exact derivatives of every order.
#include "kernel/geometry/curve.hpp"
#include "kernel/geometry/enclosure.hpp"
#include "kernel/geometry/surface.hpp"
#include "kernel/math/taylor.hpp"

namespace blendwright {

/// Makes a ParametricSurface of a Shape with
///     template <class T> std::array<T, 3> operator()(const T& u, const T& v) const;
///     SurfaceDomain domain() const;
template <class Shape>
class FormulaSurface {
 public:
  FormulaSurface(Shape shape) : shape_(std::move(shape)) {}  // NOLINT: a shape is a surface
  [[nodiscard]] SurfaceJet jet(UV p) const {
    const auto s = shape_(Taylor2<2>::u_variable(p.u), Taylor2<2>::v_variable(p.v));
    const auto c = [&](std::size_t k) { return Vec3(s[0].c[k], s[1].c[k], s[2].c[k]); };
    return {c(0), c(1), c(2), 2.0 * c(3), c(4), 2.0 * c(5)};
  }
  [[nodiscard]] SurfacePartials partials(UV p) const {
    const auto s = shape_(Taylor2<4>::u_variable(p.u), Taylor2<4>::v_variable(p.v));
    SurfacePartials P;
    for (int n = 0; n <= 4; ++n)
      for (int j = 0; j <= n; ++j)
        P(n - j, j) = Vec3(s[0].derivative(n - j, j), s[1].derivative(n - j, j), s[2].derivative(n - j, j));
    return P;
  }
  [[nodiscard]] SurfaceDomain domain() const { return shape_.domain(); }
  void enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const {
    fill(out, shape_(ModelJet::u_variable(u), ModelJet::v_variable(v)));
  }
  [[nodiscard]] const Shape& shape() const { return shape_; }

 private:
  Shape shape_;
};

/// Makes a ParametricCurve<Dim> of a Shape with
///     template <class T> std::array<T, Dim> operator()(const T& v) const;  CurveDomain domain() const;
template <class Shape, int Dim>
class FormulaCurve {
 public:
  FormulaCurve(Shape shape) : shape_(std::move(shape)) {}  // NOLINT: a shape is a curve
  [[nodiscard]] CurveJet<Dim> jet(double v) const {
    const auto s = shape_(Taylor<3>::variable(v));
    CurveJet<Dim> j;
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < Dim; ++d)
        j.D[static_cast<std::size_t>(k)][d] = s[static_cast<std::size_t>(d)].derivative(k);
    return j;
  }
  [[nodiscard]] CurveDomain domain() const { return shape_.domain(); }
  void enclose(const TaylorModel& v, CurveEnclosure& out) const {
    fill(out, shape_(ModelJet::u_variable(v)));
  }
  [[nodiscard]] const Shape& shape() const { return shape_; }

 private:
  Shape shape_;
};

}  // namespace blendwright
