#pragma once
// Private: the formulas of fitted nodes for a number type T with +, -, *, /, exp, log, sqrt: double, or one
// that carries derivatives. Each quotes the kind of node that it repeats; tests compare them with the scene's
// own evaluation.
#include <cmath>

#include "implicit/fit/fit_model.hpp"

namespace blendwright::detail {

template <class T>
using Point = std::array<T, 3>;

template <class T>
[[nodiscard]] T power(const T& x, const T& n) {  // x > 0
  using std::exp, std::log;
  return exp(n * log(x));
}

/// N_n(u) = m (sum (u_i/m)^n)^(1/n), m = max u_i; u_i >= 0. Terms below 1e-12 m add nothing.
template <class T, std::size_t k>
[[nodiscard]] T p_norm(const std::array<T, k>& u, const T& n) {
  T m = u[0];
  for (const T& x : u)
    if (x > m) m = x;
  if (!(m > T(0.0))) return T(0.0);
  T sum(0.0);
  for (const T& x : u) {
    const T ratio = x / m;
    if (ratio > T(1e-12)) sum = sum + power(ratio, n);
  }
  return m * power(sum, T(1.0) / n);
}

template <class T>
[[nodiscard]] T magnitude(const T& x) {
  return x < T(0.0) ? -x : x;
}

/// exp([w]) y, by Rodrigues; the series keeps derivatives at w = 0.
template <class T>
[[nodiscard]] Point<T> turned(const Point<T>& w, const Point<T>& y) {
  using std::cos, std::sin, std::sqrt;
  const T t2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
  T a(1.0), b(0.5);  // sin t / t, (1 - cos t) / t^2
  if (t2 > T(1e-6)) {
    const T t = sqrt(t2);
    a = sin(t) / t;
    b = (T(1.0) - cos(t)) / t2;
  } else {
    a = T(1.0) - t2 / 6.0;
    b = T(0.5) - t2 / 24.0;
  }
  const Point<T> c{w[1] * y[2] - w[2] * y[1], w[2] * y[0] - w[0] * y[2], w[0] * y[1] - w[1] * y[0]};
  const Point<T> cc{w[1] * c[2] - w[2] * c[1], w[2] * c[0] - w[0] * c[2], w[0] * c[1] - w[1] * c[0]};
  return {y[0] + a * c[0] + b * cc[0], y[1] + a * c[1] + b * cc[1], y[2] + a * c[2] + b * cc[2]};
}

/// P(d) of the potential, d >= 0.
template <class T>
[[nodiscard]] T potential(FitNode::Potential kind, const T& d, const T& s) {
  using std::exp;
  const T u = d * d;
  if (kind == FitNode::Potential::gaussian) return exp(u * (-4.0 * std::log(2.0)));
  if (!(d < T(1.0))) return T(0.0);
  const T rest = T(1.0) - u;
  if (kind == FitNode::Potential::wyvill) return T(1.0) - (u * 22.0 - u * u * 17.0 + u * u * u * 4.0) / 9.0;
  if (kind == FitNode::Potential::gaussian_windowed)
    return rest * rest * exp(u * (-4.0 * std::log(9.0 / 8.0)));
  if (d > T(0.5)) return rest * rest / (T(0.75) - s + (T(1.5) + s * 4.0) * u);
  if (!(u > T(0.0))) return T(1.0);
  return T(1.0) - u * u * 9.0 / (s + (T(4.5) - s * 4.0) * u);
}

/// T(d) of the range map.
template <class T>
[[nodiscard]] T range_map(const T& d, const T& w1, const T& w2) {
  const T t = d - T(0.5);
  if (!(t < T(0.0))) return t < w1 * 0.5 ? T(0.5) + t / w1 : T(1.0);
  if (t < w2 * -0.5) return T(0.0);
  const T A = (T(1.0) / w1 - T(1.0) / w2) * 2.0 / w2;
  return T(0.5) + t / w1 + A * t * t;
}

/// A distance with the length |Y| s of the point in the frame of its form.
template <class T>
struct Reached {
  T d, ray;
};

template <class T>
class FitEvaluation {
 public:
  FitEvaluation(const FitModel& model, const T* values) : model_(model), p_(values) {}

  /// d of a distance node at X.
  [[nodiscard]] Reached<T> distance(std::size_t node, const Point<T>& X) const {
    const FitNode& n = model_.nodes[node];
    if (n.kind == FitNode::Kind::place) {
      Reached<T> inner = distance(n.of[0], local(n, X));
      inner.ray = inner.ray * value(n, 6);
      return inner;
    }
    const T r2 = X[0] * X[0] + X[1] * X[1] + X[2] * X[2];
    using std::sqrt;
    const T r = r2 > T(0.0) ? T(sqrt(r2)) : T(0.0);
    if (n.kind != FitNode::Kind::ray_scaling) return {form(n, X), r};
    const T d = distance(n.of[0], X).d, by = distance(n.of[1], X).d;  // d (r/T)^n
    return {r > T(0.0) && by > T(0.0) ? d * power(r / by, value(n, 0)) : T(0.0), r};
  }

  /// f of a field node at X; `nearest` becomes the least ray distance |Y| s |1 - 1/(2d)| to a member.
  [[nodiscard]] T field(std::size_t node, const Point<T>& X, T& nearest) const {
    const FitNode& n = model_.nodes[node];
    if (n.kind == FitNode::Kind::place) return field(n.of[0], local(n, X), nearest);
    if (n.kind == FitNode::Kind::soft_blend) {
      T sum(0.0);
      for (const std::size_t member : n.of) sum = sum + field(member, X, nearest);
      return sum;
    }
    const Reached<T> at = distance(n.of[0], X);
    const T miss = at.d > T(0.0) ? at.ray * (T(1.0) - T(0.5) / at.d) : -at.ray;
    if (magnitude(miss) < magnitude(nearest)) nearest = miss;
    return potential(n.potential, range_map(at.d, value(n, 0), value(n, 1)), value(n, 2));
  }

 private:
  [[nodiscard]] const T& value(const FitNode& n, std::size_t i) const { return p_[n.slot + i]; }

  /// Y of X = m + s exp([w]) R0 Y; slots: m, w, s.
  [[nodiscard]] Point<T> local(const FitNode& n, const Point<T>& X) const {
    const Point<T> moved{X[0] - value(n, 0), X[1] - value(n, 1), X[2] - value(n, 2)};
    const Point<T> y = turned<T>({-value(n, 3), -value(n, 4), -value(n, 5)}, moved);
    Point<T> out;
    for (Eigen::Index i = 0; i < 3; ++i)
      out[static_cast<std::size_t>(i)] =
          (y[0] * n.turn(0, i) + y[1] * n.turn(1, i) + y[2] * n.turn(2, i)) / value(n, 6);
    return out;
  }

  [[nodiscard]] T form(const FitNode& n, const Point<T>& Y) const {
    if (n.kind == FitNode::Kind::form_asymmetric) {  // half-axes: x+, x-, y+, y-, z+, z-; n
      std::array<T, 3> u{};
      for (std::size_t i = 0; i < 3; ++i)
        u[i] = Y[i] < T(0.0) ? -Y[i] / value(n, 2 * i + 1) : Y[i] / value(n, 2 * i);
      return p_norm(u, value(n, 6));
    }
    const T x = magnitude(Y[0]) / value(n, 0), y = magnitude(Y[1]) / value(n, 1),
            z = magnitude(Y[2]) / value(n, 2);
    if (n.kind == FitNode::Kind::form_lp) return p_norm<T, 3>({x, y, z}, value(n, 3));
    return p_norm<T, 2>({p_norm<T, 2>({x, y}, value(n, 3)), z}, value(n, 4));
  }

  const FitModel& model_;
  const T* p_;
};

}  // namespace blendwright::detail
