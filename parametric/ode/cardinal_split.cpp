// Split route: even and odd parts about u = 1/2, t = u - 1/2, c_i = C_Li(1/2), s_i = F_Li(1/2):
//   We = c1 L2 s2 - c2 L1 s1                              Wo = s1 c2 - s2 c1
//   Pe = [C_L1(t) L2 s2 - C_L2(t) L1 s1] / We             Qe = [C_L2(t) c1 - C_L1(t) c2] / We
//   Po = [F_L1(t) c2 - F_L2(t) c1] / Wo                   Qo = [F_L2(t) s1 - F_L1(t) s2] / Wo (1)
// P has position 1 at u = 1, Q has slope 1 there. Functions of a positive L are divided by cosh(sqrt(L)/2).
// Formula sheet 1.5. Regimes B, D+, D-, and A, C with roots far apart.
#include <algorithm>
#include <cmath>

#include "parametric/ode/cardinal_routes.hpp"

namespace blendwright::detail {
namespace {

/// C_L and F_L about the middle; for L > 0 without the factor cosh(sqrt(L)/2).
class Column {
 public:
  explicit Column(double L) : L_(L), r_(std::sqrt(std::abs(L))) {
    c_ = L > 0.0 ? 1.0 : std::cos(0.5 * r_);
    s_ = L == 0.0 ? 0.5 : (L > 0.0 ? std::tanh(0.5 * r_) : std::sin(0.5 * r_)) / r_;
  }
  [[nodiscard]] double L() const { return L_; }
  [[nodiscard]] double c() const { return c_; }
  [[nodiscard]] double s() const { return s_; }
  struct Values {
    std::array<double, 4> C, F;  ///< derivatives 0..3
  };
  [[nodiscard]] Values at(double u, double w) const {
    const double t = 0.5 * (u - w), at = std::abs(t);
    double C = 1.0, F = t;
    if (L_ > 0.0) {  // |t| - 1/2 = -min(u, w)
      const double e = std::exp(-r_ * std::min(u, w)) / (1.0 + std::exp(-r_));
      C = e * (1.0 + std::exp(-2.0 * r_ * at));
      F = std::copysign(e * -std::expm1(-2.0 * r_ * at) / r_, t);
    } else if (L_ < 0.0) {
      C = std::cos(r_ * t);
      F = std::sin(r_ * t) / r_;
    }
    return {{C, L_ * F, L_ * C, L_ * L_ * F}, {F, C, L_ * F, L_ * C}};
  }

 private:
  double L_, r_, c_, s_;
};

class SplitRoute final : public CardinalBasis::Impl {
 public:
  SplitRoute(const Characteristic& ch, const RealSquares& L)
      : Impl(4, 1.0, ch.stiffness()), one_(L.L1), two_(L.L2) {
    const double c1 = one_.c(), s1 = one_.s(), c2 = two_.c(), s2 = two_.s();
    We_ = c1 * two_.L() * s2 - c2 * one_.L() * s1;
    Wo_ = s1 * c2 - s2 * c1;
    // Norms of the two columns against their determinant, slopes scaled by mu.
    const double mu = std::max(1.0, std::sqrt(std::abs(one_.L())));
    const double even =
        std::hypot(c1, one_.L() * s1 / mu) * std::hypot(c2, two_.L() * s2 / mu) * mu / std::abs(We_);
    const double odd = std::hypot(mu * s1, c1) * std::hypot(mu * s2, c2) / (mu * std::abs(Wo_));
    kappa = std::max(even, odd);
    refuse_resonance(ch, even > odd ? ModeFamily::even : ModeFamily::odd, kappa);
  }
  CardinalValues at(double u, double w) const override {
    const Column::Values f1 = one_.at(u, w), f2 = two_.at(u, w);
    const double c1 = one_.c(), s1 = one_.s(), c2 = two_.c(), s2 = two_.s(), L1 = one_.L(), L2 = two_.L();
    EndFunctions even{}, odd{};
    for (std::size_t j = 0; j < 4; ++j) {
      even[j][0] = (f1.C[j] * (L2 * s2) - f2.C[j] * (L1 * s1)) / We_;
      even[j][1] = (f2.C[j] * c1 - f1.C[j] * c2) / We_;
      odd[j][0] = (f1.F[j] * c2 - f2.F[j] * c1) / Wo_;
      odd[j][1] = (f2.F[j] * s1 - f1.F[j] * s2) / Wo_;
    }
    return from_parity(2, even, odd);
  }

 private:
  Column one_, two_;
  double We_ = 0.0, Wo_ = 0.0;
};

}  // namespace

Route split_route(const Characteristic& ch) { return std::make_shared<SplitRoute>(ch, real_squares(ch)); }

}  // namespace blendwright::detail
