#pragma once
// Liming's blend of two fields A, B by a third, P, level function (Liming 1944, 1979).
//   L = (1 - u) A B - u P^(n+1),  0 < u < 1                                                              (1)
// L = 0 touches A = 0 and B = 0 where P cuts them; n = 1 a conic for planes, larger n a contact of order n
// (functional spline: Li, Hoschek and Hartmann 1990). The printed form has a plus: then A and B need
// different signs. L is a curve's function, not that of a solid: it is positive again where A and B are both
// negative. The blend of given reach, clipped to where it joins two solids: a = -f1, b = -f2,
//   Phi = u (P+)^2 - (1 - u) c_a c_b a b,  P = r - c_a a - c_b b                                         (2)
// touches f1 = 0 at b = r/c_b and f2 = 0 at a = r/c_a; Phi >= 0 is the union of both with the fillet. (2) is
// meant for a, b > 0; here the product is left out where both are negative, and then Phi is positive wherever
// f1 or f2 is (derived): continuous, and C1 but for a = 0 or b = 0 inside the other solid.
// Arguments and values saturate at +-1e100. Ranges: term by term.
#include "implicit/eval/op.hpp"
#include "implicit/operators/function_join.hpp"

namespace blendwright::detail {

/// (1): arguments A, B, P.
struct Liming {
  double u = 1.0 / 3.0;
  int n = 1;
};
/// (2): arguments f1, f2.
struct LimingClipped {
  double c_a = 1.0, c_b = 1.0, r = 1.0, u = 1.0 / 3.0;
  Join join = Join::unite;
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::Liming>();
template <>
const Op& op_for<detail::LimingClipped>();
}  // namespace blendwright
