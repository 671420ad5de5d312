#pragma once
// Vectors of Taylor series along v: how cross-boundary data gets exact derivatives along a trimline.
#include <array>

#include "kernel/geometry/curve.hpp"
#include "kernel/geometry/surface.hpp"
#include "kernel/math/taylor.hpp"

namespace blendwright {

using Series = Taylor<3>;
using Series2 = std::array<Series, 2>;
using Series3 = std::array<Series, 3>;

[[nodiscard]] inline Series3 operator+(const Series3& a, const Series3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
[[nodiscard]] inline Series3 operator-(const Series3& a, const Series3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
[[nodiscard]] inline Series3 operator*(const Series& s, const Series3& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
[[nodiscard]] inline Series3 operator*(double s, const Series3& a) { return {s * a[0], s * a[1], s * a[2]}; }
[[nodiscard]] inline Series dot(const Series3& a, const Series3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline Series3 cross(const Series3& a, const Series3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
[[nodiscard]] inline Series norm(const Series3& a) { return sqrt(dot(a, a)); }
[[nodiscard]] inline Series3 normalized(const Series3& a) { return (1.0 / norm(a)) * a; }
[[nodiscard]] inline Series3 differentiated(const Series3& a) {
  return {a[0].differentiated(), a[1].differentiated(), a[2].differentiated()};
}
[[nodiscard]] inline Series3 constant(const Vec3& x) { return {Series(x[0]), Series(x[1]), Series(x[2])}; }
/// k-th derivative of every coordinate.
[[nodiscard]] inline Vec3 derivative(const Series3& a, int k) {
  return {a[0].derivative(k), a[1].derivative(k), a[2].derivative(k)};
}

/// A curve's jet as series; exact to order 3.
template <int Dim>
[[nodiscard]] std::array<Series, static_cast<std::size_t>(Dim)> to_series(const CurveJet<Dim>& jet) {
  std::array<Series, static_cast<std::size_t>(Dim)> s;
  for (std::size_t d = 0; d < static_cast<std::size_t>(Dim); ++d) {
    double f = 1.0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (k > 1) f *= static_cast<double>(k);
      s[d].c[k] = jet.D[k][static_cast<Eigen::Index>(d)] / f;
    }
  }
  return s;
}
template <std::size_t Dim>
[[nodiscard]] CurveJet<static_cast<int>(Dim)> to_jet(const std::array<Series, Dim>& s) {
  CurveJet<static_cast<int>(Dim)> jet;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t d = 0; d < Dim; ++d)
      jet.D[k][static_cast<Eigen::Index>(d)] = s[d].derivative(static_cast<int>(k));
  return jet;
}

/// The partial derivative d^{i+j} P / du^i dv^j of a surface along the parameter curve (u(h), v(h)) whose
/// constant terms are the point where `P` was taken; exact to order min(3, 4 - i - j), higher coefficients
/// are 0.
[[nodiscard]] Series3 along(const SurfacePartials& P, int i, int j, const Series2& uv);

}  // namespace blendwright
