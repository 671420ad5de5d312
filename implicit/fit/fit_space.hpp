#pragma once
// Private: a number with its derivatives along x, y and z, over any number type T that the formulas of
// fit_formula.hpp take: with T carrying derivatives by the unknowns, so does the gradient.
#include <array>
#include <cmath>
#include <type_traits>

namespace blendwright::detail {

template <class T>
struct Spatial {
  T v;
  std::array<T, 3> g;

  Spatial() : Spatial(0.0) {}
  explicit Spatial(double value) : v(value), g{T(0.0), T(0.0), T(0.0)} {}
  explicit Spatial(const T& value) requires(!std::is_same_v<T, double>)
      : v(value), g{T(0.0), T(0.0), T(0.0)} {}
  Spatial(const T& value, const std::array<T, 3>& gradient) : v(value), g(gradient) {}

  /// f(v) with f' = slope.
  [[nodiscard]] Spatial chained(const T& value, const T& slope) const {
    return {value, {slope * g[0], slope * g[1], slope * g[2]}};
  }
  friend Spatial operator-(const Spatial& a) { return {-a.v, {-a.g[0], -a.g[1], -a.g[2]}}; }
  friend Spatial operator+(const Spatial& a, const Spatial& b) {
    return {a.v + b.v, {a.g[0] + b.g[0], a.g[1] + b.g[1], a.g[2] + b.g[2]}};
  }
  friend Spatial operator-(const Spatial& a, const Spatial& b) {
    return {a.v - b.v, {a.g[0] - b.g[0], a.g[1] - b.g[1], a.g[2] - b.g[2]}};
  }
  friend Spatial operator*(const Spatial& a, const Spatial& b) {
    return {a.v * b.v,
            {a.g[0] * b.v + b.g[0] * a.v, a.g[1] * b.v + b.g[1] * a.v, a.g[2] * b.v + b.g[2] * a.v}};
  }
  friend Spatial operator/(const Spatial& a, const Spatial& b) {
    const T q = a.v / b.v;
    return {q, {(a.g[0] - q * b.g[0]) / b.v, (a.g[1] - q * b.g[1]) / b.v, (a.g[2] - q * b.g[2]) / b.v}};
  }
  friend Spatial operator*(const Spatial& a, double s) {
    return {a.v * s, {a.g[0] * s, a.g[1] * s, a.g[2] * s}};
  }
  friend Spatial operator/(const Spatial& a, double s) { return a * (1.0 / s); }
  friend bool operator<(const Spatial& a, const Spatial& b) { return a.v < b.v; }
  friend bool operator>(const Spatial& a, const Spatial& b) { return a.v > b.v; }

  friend Spatial exp(const Spatial& a) {
    using std::exp;
    const T e = exp(a.v);
    return a.chained(e, e);
  }
  friend Spatial log(const Spatial& a) {
    using std::log;
    return a.chained(log(a.v), T(1.0) / a.v);
  }
  friend Spatial sqrt(const Spatial& a) {
    using std::sqrt;
    const T s = sqrt(a.v);
    return a.chained(s, T(0.5) / s);
  }
  friend Spatial sin(const Spatial& a) {
    using std::cos, std::sin;
    return a.chained(sin(a.v), cos(a.v));
  }
  friend Spatial cos(const Spatial& a) {
    using std::cos, std::sin;
    return a.chained(cos(a.v), -sin(a.v));
  }
};

}  // namespace blendwright::detail
