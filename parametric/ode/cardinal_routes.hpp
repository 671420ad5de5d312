#pragma once
// The evaluation routes behind CardinalBasis: one class per stable form of the cardinal functions.
#include <memory>

#include "parametric/ode/cardinal_basis.hpp"
#include "parametric/ode/characteristic.hpp"

namespace blendwright {

struct CardinalBasis::Impl {
  Impl(int count_, double kappa_, double stiffness_) : count(count_), kappa(kappa_), stiffness(stiffness_) {}
  virtual ~Impl() = default;
  [[nodiscard]] virtual CardinalValues at(double u, double w) const = 0;  ///< w = 1 - u
  int count;
  double kappa;
  double stiffness;
};

namespace detail {

using Route = std::shared_ptr<const CardinalBasis::Impl>;

/// max(|p|, sqrt|s|) <= 4: power series. Any signs of p and s.
[[nodiscard]] Route series_route(const Characteristic& ch);
/// s > 0, L1 and L2 not far apart (or complex): products of functions of the half sum and half difference.
[[nodiscard]] Route product_route(const Characteristic& ch);
/// L1 and L2 real and well separated: even and odd parts about u = 1/2.
[[nodiscard]] Route split_route(const Characteristic& ch);
/// The repeated real root q >= 0, accurate to the last digits also where a function has a double zero.
[[nodiscard]] Route repeated_root_route(double q);
/// Sixth order with q <= 3: power series and a 3 x 3 system.
[[nodiscard]] Route sixth_series_route(SixthOrderFamily family, double q);
/// Sixth order with q > 3: boundary-layer exponentials and polynomials, split into even and odd parts.
[[nodiscard]] Route sixth_layer_route(SixthOrderFamily family, double q);

/// value[j][i]: j-th derivative of the cardinal function of datum i at u = 1 (i = 0 position, 1 first, 2
/// second derivative). Those of the data at u = 0 follow by u -> 1 - u, sign (-1)^(i + j).
using EndFunctions = std::array<std::array<double, 3>, 4>;

/// All functions from the end-1 functions taken at u and at w.
[[nodiscard]] inline CardinalValues reflected(int data, const EndFunctions& at_u, const EndFunctions& at_w) {
  CardinalValues all;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < static_cast<std::size_t>(data); ++i) {
      all.value[j][i] = (i + j) % 2 == 0 ? at_w[j][i] : -at_w[j][i];
      all.value[j][i + static_cast<std::size_t>(data)] = at_u[j][i];
    }
  return all;
}

/// All functions from even[j][i], odd[j][i]: the even and odd solutions with datum i = 1 at u = 1, j-th
/// derivative.
[[nodiscard]] inline CardinalValues from_parity(int data, const EndFunctions& even, const EndFunctions& odd) {
  CardinalValues all;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < static_cast<std::size_t>(data); ++i) {
      const double sign = i % 2 == 0 ? 0.5 : -0.5;
      all.value[j][i] = sign * (even[j][i] - odd[j][i]);
      all.value[j][i + static_cast<std::size_t>(data)] = 0.5 * (even[j][i] + odd[j][i]);
    }
  return all;
}

/// f2 (f2''(0) = 1) and f3, its antiderivative (f3'''(0) = 1), the solutions of the sweep equation that
/// vanish doubly at u = 0, as power series: f2 = sum_m g_m u^(2m) / (2m)!, m >= 1.
class CauchySeries {
 public:
  static constexpr std::size_t terms = 20;
  /// g[m - 1] = g_m.
  explicit CauchySeries(const std::array<double, terms>& g);
  struct Values {
    double f3, f2, d1, d2, d3;  ///< d_j = j-th derivative of f2
  };
  [[nodiscard]] Values at(double u) const;
  [[nodiscard]] const Values& at_one() const { return one_; }
  /// H1 = [f2(u) f2(1) - f3(u) f2'(1)] / W, K1 = [f3(u) f2(1) - f2(u) f3(1)] / W, W = f2(1)^2 - f3(1) f2'(1).
  /// (1)
  [[nodiscard]] EndFunctions end_functions(double u) const;
  [[nodiscard]] double wronskian() const { return W_; }

 private:
  std::array<double, terms> f3_, f2_, d1_, d2_, d3_;
  Values one_;
  double W_;
};

}  // namespace detail
}  // namespace blendwright
