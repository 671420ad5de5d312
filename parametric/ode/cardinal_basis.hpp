#pragma once
// Cardinal functions of the sweep equation and of its sixth-order relatives: the closed-form generators of a
// blend.
//
//   fourth order:  G(u) = H0(u) C0 + K0(u) T0 + H1(u) C1 + K1(u) T1
//   sixth order:   G(u) = the same with six functions, in the order pos0, d0, dd0, pos1, d1, dd1
// Stable evaluation routes of the formula sheet, sections 1.3-1.6 and 3; measured error <= 1e-14 max(1,
// kappa) of the largest |phi_k^(j)|, derivative orders j = 0..3.
#include <array>
#include <memory>
#include <string_view>

#include "parametric/ode/sweep_ode.hpp"

namespace blendwright {

enum class SixthOrderFamily {
  quintic,
  tension1,
  tension2,
  triple
};  ///< characteristic L^3; L^2(L-q^2); L(L-q^2)^2; (L-q^2)^3
[[nodiscard]] const char* name(SixthOrderFamily f);

/// value[j][k]: j-th derivative of cardinal function k. Fourth order uses k = 0..3 in the order H0, K0, H1,
/// K1; sixth order k = 0..5 in the order pos0, d0, dd0, pos1, d1, dd1.
struct CardinalValues {
  std::array<std::array<double, 6>, 4> value{};
};

/// A set of cardinal functions, as an immutable value (coefficients are prepared once).
class CardinalBasis {
 public:
  /// Throws InputError (b = 0, not finite) and ResonanceError.
  [[nodiscard]] static CardinalBasis fourth_order(const SweepOde& ode);
  /// E+ with exact q >= 0 (not through b, c, d). q = 0 is the cubic.
  [[nodiscard]] static CardinalBasis repeated_root(double q);
  /// q: tension, >= 0 and finite; ignored by quintic.
  [[nodiscard]] static CardinalBasis sixth_order(SixthOrderFamily family, double q);

  [[nodiscard]] int count() const;  ///< 4 or 6
  [[nodiscard]] double kappa()
      const;  ///< condition number of the boundary problem; above 1e3 the shape is wild: warn
  [[nodiscard]] double stiffness() const;  ///< largest |root|: width of the boundary layers is 1/stiffness
  /// u in [0, 1]; `w` = 1 - u when it is known better than by subtraction.
  [[nodiscard]] CardinalValues operator()(double u) const;
  [[nodiscard]] CardinalValues operator()(double u, double w) const;

  struct Impl;

 private:
  explicit CardinalBasis(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

}  // namespace blendwright
