#pragma once
// Material that is added to (a0 > 0) or taken from (a0 < 0) an operation on f1, f2 next to their edge f1 = f2
// = 0, level function.
//   D = a0/(1 + (f1/a1)^2 + (f2/a2)^2)                      Pasko, Adzhiev, Sourin and Savchenko 1995     (1)
//   D = a0 (1 - q)^3/(1 + q), q = r1/(r1 + r3)              Pasko, Pasko, Ikeda and Kunii 2002            (2)
//   r1 = (f1/a1)^2 + (f2/a2)^2, r3 = (f3/a3)^2 where f3 > 0; q = 1 elsewhere
// (1) decays but is nowhere 0. (2) is exactly 0, with derivatives 0, where f3 <= 0. In (2)
//   (1 - q)^3/(1 + q) = r3^3/((r1 + r3)^2 (2 r1 + r3))                                                   (3)
// is a function of ratios: C2 but for f1 = f2 = f3 = 0, where it is 0 and its gradient next to it is
// unbounded. a1, a2, a3 > 0. Fields saturate at +-1e100. Ranges: end points of magnitudes.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

/// (1): arguments f1, f2.
struct EdgeMaterial {
  double a0 = 1.0, a1 = 1.0, a2 = 1.0;
};
/// (2): arguments f1, f2, f3.
struct BoundedMaterial {
  double a0 = 1.0, a1 = 1.0, a2 = 1.0, a3 = 1.0;
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::EdgeMaterial>();
template <>
const Op& op_for<detail::BoundedMaterial>();
}  // namespace blendwright
