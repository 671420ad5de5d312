#pragma once
// The sweep equation, its root regimes and its resonances (formula sheet, sections 1.1, 1.2, 1.7).
//
// b G''''(u) + c G''(u) + d G(u) = 0,  u in [0, 1], b != 0                                                (1)
// p = -c/b, s = d/b;  L^2 - p L + s = 0 for L = r^2, r a root of (1)                                      (2)
// b, c, d: dimensionless shape controls; a common factor changes nothing.
// Source: You, Ugail, Tang, You, Zhang, Sweeping based controllable surface blending, eq. (2); the regimes
// beyond c^2 = 4bd are ours.
#include <string>

#include "kernel/base/error.hpp"

namespace blendwright {

struct SweepOde {
  double b = 1.0, c = 0.0, d = 0.0;
  bool operator==(const SweepOde&) const = default;
  /// The paper's regime with the repeated real root q: b = 1, c = -2 q^2, d = q^4.
  [[nodiscard]] static SweepOde repeated_root(double q) { return {1.0, -2.0 * q * q, q * q * q * q}; }
  /// The tension spline with roots 0, 0, +-tau: b = 1, c = -tau^2, d = 0.
  [[nodiscard]] static SweepOde tension(double tau) { return {1.0, -tau * tau, 0.0}; }
};

/// The root regimes of (1), by the signs of D = c^2 - 4bd, c/b and d/b:
///   A   D > 0, c/b < 0, d/b > 0   four real roots            E+  D = 0, c/b < 0   a double real root (the
///   paper) B   d/b < 0                   two real, two imaginary    E-  D = 0, c/b > 0   a double imaginary
///   root C   D > 0, c/b > 0, d/b > 0   four imaginary roots       E0  c = d = 0        zero four times
///   (cubic) D+  d = 0, c/b < 0            0, 0 and two real          F   D < 0            complex roots D-
///   d = 0, c/b > 0            0, 0 and two imaginary
enum class Regime { A, B, C, Dplus, Dminus, E0, Eplus, Eminus, F };
[[nodiscard]] const char* name(Regime r);  ///< "A", "B", "C", "D+", "D-", "E0", "E+", "E-", "F"

/// The sign of D is exact: c^2 and 4bd are compared without rounding. Throws InputError naming the parameter:
/// b = 0, a value that is not finite, or a ratio c/b, d/b beyond the number range.
[[nodiscard]] Regime regime(const SweepOde& ode);

/// The boundary-value problem is singular (or nearly: kappa > 1e8) at these parameters.
class ResonanceError : public GeometryError {
 public:
  ResonanceError(std::string family, double kappa, Regime r, double nearest_mode);
  std::string family;  ///< "even" or "odd" about u = 1/2
  double kappa = 0.0;  ///< condition number
  Regime root_regime;
  double nearest_mode;  ///< the value of the oscillatory root (om, or om2) at the resonance next to these
                        ///< parameters
};

}  // namespace blendwright
