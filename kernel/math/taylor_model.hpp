#pragma once
// Taylor models in one variable: functions enclosed between the samples, rounding included.
//
//   f(x) in  sum_k c[k] x^k + [-radius, radius]   for every x in [-1, 1],   k <= order (1)
// x is the place within a piece of the parameter that is looked at: v = middle + half x. Sums and products
// keep (1) for exact arithmetic on the exact values: what leaves the order, and every rounding of a
// coefficient, goes into the radius, which is itself rounded up. A function f of a model a = a0 + d, with a0
// the constant coefficient and |d| <= D, is
//   f(a) = sum_{k<=order} f^(k)(a0)/k! d^k + R,   |R| <= D^(order+1) sup |f^(order+1)| / (order+1)! (2)
// with the derivatives in interval arithmetic. Where a function is not defined somewhere within the model's
// range the result is unbounded. Source: Makino and Berz, Taylor models and other validated functional
// inclusion methods, Int. J. Pure Appl. Math. 4 (2003).
#include <array>

#include "kernel/math/interval.hpp"

namespace blendwright {

class TaylorModel {
 public:
  static constexpr int order = 8;

  TaylorModel() = default;
  TaylorModel(double x) { c_[0] = x; }  // NOLINT: constants mix freely with models
  TaylorModel(const Bounds& x);         // NOLINT: so do bounded constants
  /// The parameter itself over [lo, hi], without a radius: middle + half x, with half rounded up so that
  /// every value is reached.
  [[nodiscard]] static TaylorModel parameter(double lo, double hi);
  /// A quantity of which nothing is known.
  [[nodiscard]] static TaylorModel unknown() { return {unbounded()}; }

  [[nodiscard]] double coefficient(int k) const { return c_[static_cast<std::size_t>(k)]; }
  [[nodiscard]] double radius() const { return radius_; }
  [[nodiscard]] bool finite() const;
  [[nodiscard]] bool is_zero() const { return degree_ == 0 && c_[0] == 0.0 && radius_ == 0.0; }
  /// True for a single double, known exactly.
  [[nodiscard]] bool exact() const { return degree_ == 0 && radius_ == 0.0; }
  [[nodiscard]] double centre() const { return c_[0]; }
  /// Bounds over x in [-1, 1].
  [[nodiscard]] Bounds range() const;
  /// Bounds at one x in [-1, 1].
  [[nodiscard]] Bounds at(double x) const;
  /// The same polynomial with the radius r.
  [[nodiscard]] TaylorModel with_radius(double r) const;
  /// A model that contains both.
  [[nodiscard]] static TaylorModel hull(const TaylorModel& a, const TaylorModel& b);

  /// The mean of f between x0 and x, x0 in [-1, 1]:
  ///   1/(x - x0) int_x0^x f = sum_k c[k]/(k+1) (x^k + x^(k-1) x0 + ... + x0^k) + [-radius, radius] (3)
  /// A model that vanishes at x0 is (x - x0) times the mean of its derivative.
  [[nodiscard]] TaylorModel mean_from(const Bounds& x0) const;

  friend TaylorModel operator+(const TaylorModel& a, const TaylorModel& b);
  friend TaylorModel operator-(const TaylorModel& a, const TaylorModel& b);
  friend TaylorModel operator-(const TaylorModel& a);
  friend TaylorModel operator*(const TaylorModel& a, const TaylorModel& b);
  friend TaylorModel operator*(double s, const TaylorModel& a);
  /// (2), given f^(k)(a0)/k! and a bound of |f^(order+1)|/(order+1)! over the range of a.
  friend TaylorModel composed(const std::array<Bounds, order + 1>& f, double remainder, const TaylorModel& a);

 private:
  /// sum_k |c[k]|, rounded up.
  [[nodiscard]] double norm(std::size_t from = 0) const;
  void trim();

  std::array<double, order + 1> c_{};
  double radius_ = 0.0;
  int degree_ = 0;  ///< coefficients above are 0
};

TaylorModel operator+(const TaylorModel& a, const TaylorModel& b);
TaylorModel operator-(const TaylorModel& a, const TaylorModel& b);
TaylorModel operator-(const TaylorModel& a);
TaylorModel operator*(const TaylorModel& a, const TaylorModel& b);
TaylorModel operator*(double s, const TaylorModel& a);
TaylorModel composed(const std::array<Bounds, TaylorModel::order + 1>& f, double remainder,
                     const TaylorModel& a);
[[nodiscard]] TaylorModel operator/(const TaylorModel& a, const TaylorModel& b);
[[nodiscard]] inline TaylorModel operator*(const TaylorModel& a, double s) { return s * a; }

[[nodiscard]] TaylorModel inverse(const TaylorModel& a);
[[nodiscard]] TaylorModel sin(const TaylorModel& a);
[[nodiscard]] TaylorModel cos(const TaylorModel& a);
[[nodiscard]] TaylorModel sinh(const TaylorModel& a);
[[nodiscard]] TaylorModel cosh(const TaylorModel& a);
[[nodiscard]] TaylorModel exp(const TaylorModel& a);
[[nodiscard]] TaylorModel log(const TaylorModel& a);
/// a^p, a > 0.
[[nodiscard]] TaylorModel pow(const TaylorModel& a, double p);
[[nodiscard]] inline TaylorModel sqrt(const TaylorModel& a) { return pow(a, 0.5); }
/// Unbounded where x <= 0 meets y = 0, where the angle jumps.
[[nodiscard]] TaylorModel atan2(const TaylorModel& y, const TaylorModel& x);

}  // namespace blendwright
