#pragma once
// The characteristic equation (2) of the sweep equation, normalised and with its roots free of cancellation.
#include "parametric/ode/sweep_ode.hpp"

namespace blendwright::detail {

/// p = -c/b, s = d/b, Delta = p^2 - 4 s (from c^2 - 4bd without cancellation).
struct Characteristic {
  double p = 0.0, s = 0.0, Delta = 0.0;
  Regime regime = Regime::E0;
  [[nodiscard]] double size() const;  ///< M = max(|p|, sqrt|s|): at most 4 means that a power series is best
  [[nodiscard]] double stiffness() const;  ///< largest |r|
};
/// Throws InputError as regime() does.
[[nodiscard]] Characteristic characteristic(const SweepOde& ode);

/// The roots L1, L2 of (2) when they are real; |L1| >= |L2|, L2 by Vieta.
struct RealSquares {
  double L1 = 0.0, L2 = 0.0;
};
[[nodiscard]] RealSquares real_squares(const Characteristic& ch);

/// Squares of the half sum and the half difference of the roots, for s > 0:
/// sg2 = (p + 2 sqrt s)/4, dl2 = (p - 2 sqrt s)/4, sg2 >= dl2; smooth through D = 0.
struct HalfSquares {
  double sg2 = 0.0, dl2 = 0.0;
};
[[nodiscard]] HalfSquares half_squares(const Characteristic& ch);

/// Whether the boundary problem is singular for functions even or odd about u = 1/2.
enum class ModeFamily { even, odd };

/// Throws ResonanceError when kappa > 1e8. The nearest mode is the next root of the condition of `family`, in
/// the (larger) oscillatory root, the other root held fixed:
///   even: c1 L2 s2 = c2 L1 s1,  odd: s1 c2 = s2 c1,  with c_i = cosh(r_i/2), s_i = sinh(r_i/2)/r_i. (3)
void refuse_resonance(const Characteristic& ch, ModeFamily family, double kappa);

}  // namespace blendwright::detail
