#pragma once
// What the fourth-order cardinal functions bend at the ends, as proven bounds: the one part of an exact
// blend's second derivatives there that the boundary data do not fix.
//
// Second derivatives of H1 and K1 at u = 0 and u = 1; H0'' and K0'' follow by u -> 1 - u. Closed forms of the
// formula sheet in interval arithmetic, for the exact (b, c, d) or q:
//   |p|, sqrt|s| <= 4, series f2 = sum g_m/(2m)!, f3, f2', f2'' at u = 1 (sheet 1.6, item 1):
//     W = f2^2 - f3 f2';  H1''(0) = f2/W,  K1''(0) = -f3/W,  H1''(1) = (f2'' f2 - f2'^2)/W,
//     K1''(1) = (f2' f2 - f2'' f3)/W                                                                      (1)
//   s > 0, sqrt s > |p|/20, products (sheet 1.3), Cs = C_sg2(1), ..., Dif = sg2 - dl2, Den = Ps^2 - Pd^2:
//     H1''(0) = 2 Dif Ps Pd/Den,          K1''(0) = 2 (Ps Cd - Pd Cs)/Den,
//     H1''(1) = -Dif (Ps^2 + Pd^2)/Den,   K1''(1) = 2 (Ps Cs - Pd Cd)/Den                                 (2)
//   otherwise, even and odd parts (sheet 1.5), with Pe'' = -L1 L2 Wo/We, Qe'' = (L2 - L1) c1 c2/We,
//   Po'' = -We/Wo, Qo'' = (L2 - L1) s1 s2/Wo at u = 1:
//     H1''(1) = (Pe'' + Po'')/2,  H1''(0) = (Pe'' - Po'')/2,  K1''(1) = (Qo'' + Qe'')/2,
//     K1''(0) = (Qe'' - Qo'')/2                                                                           (3)
#include <array>

#include "kernel/math/interval.hpp"
#include "parametric/ode/sweep_ode.hpp"

namespace blendwright {

/// value[end][k]: phi_k'' at u = end, k in the order H0, K0, H1, K1. Not finite next to a resonance.
struct EndBends {
  std::array<std::array<Bounds, 4>, 2> value{};
};

/// Of an equation that CardinalBasis::fourth_order takes.
[[nodiscard]] EndBends end_bends(const SweepOde& ode);
/// Of the repeated real root q >= 0.
[[nodiscard]] EndBends end_bends(double q);

}  // namespace blendwright
