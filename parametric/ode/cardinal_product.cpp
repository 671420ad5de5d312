// Product route: with w = 1 - u, C_l(t) = cosh(sqrt(l) t), F_l(t) = sinh(sqrt(l) t)/sqrt(l) (entire in l),
// index s for l = sg2 and d for l = dl2, Ps = Fs(1), Pd = Fd(1):
//   A(u) = Fs(u) Cd(w) + Cs(u) Fd(w),  B(u) = Fs(u) Fd(w),  Den = Ps^2 - Pd^2
//   H1(u) = [Ps A(u) - Pd A(w)] / Den,  K1(u) = [Pd B(w) - Ps B(u)] / Den (1) A' = (sg2 - dl2) B,  B' = Cs(u)
//   Fd(w) - Fs(u) Cd(w),  B'' = (sg2 + dl2) B - 2 Cs(u) Cd(w), B''' = (sg2 + dl2) B' - 2 sg2 Fs(u) Cd(w) + 2
//   dl2 Cs(u) Fd(w)                                              (2)
// Every factor of argument x carries exp(sqrt(l) x) separately when l > 0, so that nothing overflows. Formula
// sheet 1.3 and 1.6, item 2. All signs of sg2 >= dl2 (regimes A, C, E+, E-, F): nothing happens at D = 0.
#include <algorithm>
#include <cmath>

#include "parametric/ode/cardinal_routes.hpp"

namespace blendwright::detail {
namespace {

/// C_l and F_l without the factor exp(rate x).
struct Scaled {
  explicit Scaled(double l_)
      : l(l_), rate(l_ > 0.0 ? std::sqrt(l_) : 0.0), om(l_ < 0.0 ? std::sqrt(-l_) : 0.0) {}
  [[nodiscard]] double C(double x) const {
    return l > 0.0 ? 0.5 * (1.0 + std::exp(-2.0 * rate * x)) : std::cos(om * x);
  }
  [[nodiscard]] double F(double x) const {
    if (l > 0.0) return -std::expm1(-2.0 * rate * x) / (2.0 * rate);
    return l < 0.0 ? std::sin(om * x) / om : x;
  }
  double l, rate, om;
};

class ProductRoute final : public CardinalBasis::Impl {
 public:
  ProductRoute(const Characteristic& ch, const HalfSquares& half)
      : Impl(4, 1.0, ch.stiffness()), s_(half.sg2), d_(half.dl2), Ps_(s_.F(1.0)), Pd_(d_.F(1.0)) {
    const double both = std::exp(-2.0 * (s_.rate - d_.rate)), none = std::exp(-2.0 * s_.rate);
    Den_ = Ps_ * Ps_ - both * Pd_ * Pd_;
    const double column = std::max({Ps_ * Ps_, both * Pd_ * Pd_, 0.25 * none / (1.0 + std::abs(s_.l)),
                                    0.25 * none / (1.0 + std::abs(d_.l))});
    kappa = column / std::abs(Den_);
    const bool same_sign = Ps_ * Pd_ > 0.0;  // Den = 0 because Ps = Pd (odd functions) or Ps = -Pd (even)
    refuse_resonance(ch, same_sign ? ModeFamily::odd : ModeFamily::even, kappa);
  }
  CardinalValues at(double u, double w) const override {
    const Pairs at_u = pairs(u, w), at_w = pairs(w, u);
    const double gap = s_.rate - d_.rate;
    const double near = std::exp(-gap * w), far = std::exp(-gap * (2.0 - w));
    const double near_w = std::exp(-gap * u), far_w = std::exp(-gap * (2.0 - u));
    return reflected(2, end_functions(at_u, at_w, near, far), end_functions(at_w, at_u, near_w, far_w));
  }

 private:
  /// A^(j)(u) and B^(j)(u), both without exp(rate_s u + rate_d w).
  struct Pairs {
    std::array<double, 4> A, B;
  };
  [[nodiscard]] Pairs pairs(double u, double w) const {
    const double Cs = s_.C(u), Fs = s_.F(u), Cd = d_.C(w), Fd = d_.F(w);
    const double sum = s_.l + d_.l, difference = s_.l - d_.l;
    Pairs v;
    v.B[0] = Fs * Fd;
    v.B[1] = Cs * Fd - Fs * Cd;
    v.B[2] = sum * v.B[0] - 2.0 * Cs * Cd;
    v.B[3] = sum * v.B[1] - 2.0 * s_.l * Fs * Cd + 2.0 * d_.l * Cs * Fd;
    v.A = {Fs * Cd + Cs * Fd, difference * v.B[0], difference * v.B[1], difference * v.B[2]};
    return v;
  }
  [[nodiscard]] EndFunctions end_functions(const Pairs& here, const Pairs& mirror, double near,
                                           double far) const {
    EndFunctions end{};
    for (std::size_t j = 0; j < 4; ++j) {
      const double sign = j % 2 == 0 ? 1.0 : -1.0;  // d/du of a function of w
      end[j][0] = (Ps_ * near * here.A[j] - sign * Pd_ * far * mirror.A[j]) / Den_;
      end[j][1] = (sign * Pd_ * far * mirror.B[j] - Ps_ * near * here.B[j]) / Den_;
    }
    return end;
  }

  Scaled s_, d_;
  double Ps_, Pd_, Den_ = 0.0;
};

}  // namespace

Route product_route(const Characteristic& ch) { return std::make_shared<ProductRoute>(ch, half_squares(ch)); }

}  // namespace blendwright::detail
