#pragma once
// Rockwood's super-elliptic blends of k fields of level function (Rockwood 1989). For the union, a_i = -f_i;
// for the intersection, a_i = f_i; a difference is the intersection of f1, -f2, ... Thumb weight w >= 1,
// reach r_i > 0:
//   K(a) = 1 - sum ((1 - a_i/r_i)+)^w                                                                    (1)
//   h(a): sum ((1 - (a_i - h)/r_i)+)^w = 1,  min(a_i - r_i) < h <= min a_i                               (2)
// h is the displacement form: a field that is min a_i where all others are larger by their r_i, and the blend
// between. With x_i = 1 - (a_i - h)/r_i and T_i = x_i+^(w-1)/r_i (implicit differentiation, derived):
//   h_i = T_i/sum T_j,   h_ij = -(1/sum T) sum_l S_l (e_l - grad h)_i (e_l - grad h)_j,
//   S_l = (w - 1) x_l+^(w-2)/r_l^2                                                                       (3)
// Partials lie in [0, 1] and their sum is 1; h is concave, C1 for w > 1, C2 for w > 2. The printed (1) has no
// clamp ( )+: w = 2 then makes a second branch, and w = 1.5 no number.
// (2) is solved for t = min a_i - h by Newton steps of the convex w-norm of x, from t = 0 where it is not
// smaller than 1: monotone, exact in one step when all a_i/r_i are alike. Local form: all r_i are multiplied
// by omega, the value of the first argument in [0, 1]; h = omega H(a/omega) is concave in (a, omega), and min
// a_i where omega < least_omega.
#include <algorithm>
#include <vector>

#include "implicit/eval/op.hpp"
#include "implicit/number/power.hpp"
#include "implicit/operators/function_join.hpp"

namespace blendwright::detail {

/// Reaches of the operands, and the weight.
struct SuperEllipse {
  std::vector<double> r, inverse_r;
  Power w, inverse_w;
  SuperEllipse(std::vector<double> r, double w);
  [[nodiscard]] double largest_r() const { return *std::max_element(r.begin(), r.end()); }
};

/// -K of the union: sum ((1 + f_i/r_i)+)^w - 1. Saturates at +-1e100. Range: end points.
struct RockwoodRaw {
  SuperEllipse shape;
};
/// (2). Range: end points. Exactly the argument that is below all others by their r.
struct Displacement {
  SuperEllipse shape;
  Join join = Join::intersect;
};
/// Below this omega counts as 0.
inline constexpr double least_omega = 1e-12;
/// (2) with r_i omega: arguments omega, f1, f2, ...
struct LocalDisplacement {
  SuperEllipse shape;
  Join join = Join::intersect;
};
/// omega(g) = t^3 (10 - 15 t + 6 t^2), t = g/fade in [0, 1]; 0 below, 1 above: C2. Range: end points.
struct Cutoff {
  double fade = 1.0;
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::RockwoodRaw>();
template <>
const Op& op_for<detail::Displacement>();
template <>
const Op& op_for<detail::LocalDisplacement>();
template <>
const Op& op_for<detail::Cutoff>();
}  // namespace blendwright
