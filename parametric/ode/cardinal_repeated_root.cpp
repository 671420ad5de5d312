// The repeated real root q, the paper's regime. With S = sinh q, C = cosh q, D = S^2 - q^2, w = 1 - u:
//   H1 = [S a(u) - q a(w)] / D,  a(u) = sinh qu + q w cosh qu (1) K1 = [q u sinh qw - w S sinh qu] / D (2)
// and, the same without cancellation at the double zero u = 0, x = qu:
//   H1 = [q^2 S u sinh x - (S + qC)(x cosh x - sinh x)] / D (3) K1 = [S (x cosh x - sinh x) - (qC - S) u sinh
//   x] / D                                                        (4)
// Formula sheet 1.6: values to the last digits pointwise, also at the double zeros, for q from 0 to 1e4 and
// beyond.
#include <cmath>

#include "parametric/ode/cardinal_routes.hpp"

namespace blendwright::detail {
namespace {

/// psi(x) = (sinh(x)/x - 1) / x^2 = sum x^(2k) / (2k + 3)!, |x| <= 3.
double psi(double x) {
  double sum = 0.0;
  for (int k = 15; k >= 0; --k) sum = sum * x * x / static_cast<double>((2 * k + 4) * (2 * k + 5)) + 1.0;
  return sum / 6.0;
}

/// x cosh x - sinh x = x^3 sum x^(2k) (2k + 2)/(2k + 3)!, |x| <= 2.
double cosh_excess(double x) {
  double sum = 0.0, factorial = 6.0, power = 1.0;
  for (int k = 0; k < 14; ++k) {
    sum += power * static_cast<double>(2 * k + 2) / factorial;
    power *= x * x;
    factorial *= static_cast<double>((2 * k + 4) * (2 * k + 5));
  }
  return sum * x * x * x;
}

/// q <= 1: power series, with the two factorised forms that keep the double zeros at u = 1.
class SmallRoot final : public CardinalBasis::Impl {
 public:
  explicit SmallRoot(double q) : Impl(4, 1.0, q), q_(q), psi_(psi(q)), series_(coefficients(q)) {
    scale_ = psi_ * (2.0 + q * q * psi_);
  }
  CardinalValues at(double u, double w) const override { return reflected(2, end(u, w), end(w, u)); }

 private:
  /// The even Maclaurin derivatives of f2 = u sinh(qu)/(2q).
  static std::array<double, CauchySeries::terms> coefficients(double q) {
    std::array<double, CauchySeries::terms> g{};
    double power = 1.0;
    for (std::size_t m = 0; m < g.size(); ++m, power *= q * q) g[m] = static_cast<double>(m + 1) * power;
    return g;
  }
  [[nodiscard]] EndFunctions end(double u, double w) const {
    EndFunctions f = series_.end_functions(u);
    const double q2 = q_ * q_, x2 = q2 * u * u, y2 = q2 * w * w;
    const double psi_u = psi(q_ * u), psi_w = psi(q_ * w);
    if (u > 0.5) f[0][1] = u * w * (w * w * psi_w - psi_ - u * u * psi_u - x2 * psi_ * psi_u) / scale_;
    f[1][0] = u * w * ((1.0 + q2 * psi_) * (1.0 + x2 * psi_u) + 1.0 + y2 * psi_w) / scale_;
    return f;
  }
  double q_, psi_, scale_ = 0.0;
  CauchySeries series_;
};

/// q > 1: numerators and D times 4 exp(-2q).
class LargeRoot final : public CardinalBasis::Impl {
 public:
  explicit LargeRoot(double q) : Impl(4, 1.0, q), q_(q), e_(std::exp(-q)), S_(-std::expm1(-2.0 * q)) {
    const double plus = S_ + 2.0 * q * e_;  // 2 exp(-q) (sinh q + q)
    const double minus = q < 3.0 ? 2.0 * e_ * q * q * q * psi(q) : S_ - 2.0 * q * e_;
    D_ = plus * minus;
    const double C = 1.0 + e_ * e_;
    qC_minus_S_ = q < 2.0 ? 2.0 * e_ * cosh_excess(q) : q * C - S_;
    S_plus_qC_ = S_ + q * C;
  }
  CardinalValues at(double u, double w) const override { return reflected(2, end(u, w), end(w, u)); }

 private:
  [[nodiscard]] EndFunctions end(double u, double w) const {
    return u <= 0.5 && q_ * u < 1.0 ? near_zero(u) : elsewhere(u, w);
  }
  /// Equations (3) and (4).
  [[nodiscard]] EndFunctions near_zero(double u) const {
    const double q = q_, x = q * u, sh = std::sinh(x), ch = std::cosh(x);
    const std::array<double, 4> P{cosh_excess(x), q * x * sh, q * q * (sh + x * ch),
                                  q * q * q * (2.0 * ch + x * sh)};
    const std::array<double, 4> Q{u * sh, sh + x * ch, q * (2.0 * ch + x * sh), q * q * (3.0 * sh + x * ch)};
    const double scale = 2.0 * e_ / D_;
    EndFunctions f{};
    for (std::size_t j = 0; j < 4; ++j) {
      f[j][0] = scale * (q * q * S_ * Q[j] - S_plus_qC_ * P[j]);
      f[j][1] = scale * (S_ * P[j] - qC_minus_S_ * Q[j]);
    }
    return f;
  }
  /// Equations (1) and (2) and their derivatives.
  [[nodiscard]] EndFunctions elsewhere(double u, double w) const {
    const double q = q_, q2 = q * q, near = S_ * std::exp(-q * w), far = 2.0 * std::exp(-q * (2.0 - w));
    const double eu = std::expm1(-2.0 * q * u), ew = std::expm1(-2.0 * q * w);
    const double Ssh = near * -eu, Sch = near * (2.0 + eu);  // 4 exp(-2q) sinh q {sinh, cosh} qu
    const double sh = far * -ew, ch = far * (2.0 + ew);      // 4 exp(-2q) {sinh, cosh} qw
    EndFunctions f{};
    f[0] = {Ssh + q * w * Sch - q * (sh + q * u * ch), q * u * sh - w * Ssh};
    f[1] = {q2 * (w * Ssh + q * u * sh), q * sh - q2 * u * ch + Ssh - q * w * Sch};
    f[2] = {q2 * (q * w * Sch - Ssh + q * sh - q2 * u * ch),
            q2 * q * u * sh - 2.0 * q2 * ch + 2.0 * q * Sch - q2 * w * Ssh};
    f[3] = {q2 * (q2 * w * Ssh - 2.0 * q * Sch - 2.0 * q2 * ch + q2 * q * u * sh),
            3.0 * q2 * q * sh - q2 * q2 * u * ch + 3.0 * q2 * Ssh - q2 * q * w * Sch};
    for (auto& row : f)
      for (double& x : row) x /= D_;
    return f;
  }
  double q_, e_, S_, D_ = 0.0, qC_minus_S_ = 0.0,
                     S_plus_qC_ = 0.0;  // S, D, .. scaled by 2 exp(-q), 4 exp(-2q)
};

}  // namespace

Route repeated_root_route(double q) {
  if (q <= 1.0) return std::make_shared<SmallRoot>(q);
  return std::make_shared<LargeRoot>(q);
}

}  // namespace blendwright::detail
