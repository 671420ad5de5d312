#pragma once
// R-functions (Rvachev 1963, 1982; Shapiro 2007) of two fields of level function. Intersections:
//   R_alpha  I = (f1 + f2 - s)/(1 + alpha),  s^2 = f1^2 + f2^2 - 2 alpha f1 f2,  -1 < alpha <= 1          (1)
//   R_0^m    I_m = I_0 rho^m,  I_0 = f1 + f2 - rho,  rho^2 = f1^2 + f2^2,  m >= 1                         (2)
// Cancellation-free (derived from (1); alpha >= 0 and < 0):
//   I = 2 f1 f2/(f1 + f2 + s) where f1 + f2 > 0                                                           (3)
//   s^2 = (f1 - f2)^2 + 2 (1 - alpha) f1 f2 = (f1 + f2)^2 - 2 (1 + alpha) f1 f2                           (4)
//   I_1 = (1 - u/s)/(1 + alpha) = (1 - alpha) f2^2/(s (s + u)) where u = f1 - alpha f2 > 0                (5)
//   second partials -b f2^2, b f1 f2, -b f1^2 (11, 12, 22), b = (1 - alpha)/s^3                           (6)
// I is homogeneous of degree 1, concave, at most min(f1, f2), analytic but at f1 = f2 = 0; partials >= 0. On
// the boundary (f1 = 0, f2 > 0) its gradient is that of f1. alpha = 1 is min: use that. At f1 = f2 = 0 (both
// below 1e-60) the gradient is the limit along f1 = f2 > 0, the mean of the two times 2/(2 + sqrt(2 - 2
// alpha)).
// I_m is homogeneous of degree m + 1, hence C^m at f1 = f2 = 0; it is not monotone and its gradient on the
// boundary is |f2|^m times that of f1. Its arguments and values saturate at +-1e100.
#include "implicit/eval/op.hpp"
#include "implicit/operators/function_join.hpp"

namespace blendwright::detail {

/// (1), alpha < 1. Range: end points.
struct RFunction {
  double alpha = 0.0;
  Join join = Join::intersect;
};
/// (2). Range: product of the ranges of I_0 and rho^m.
struct RFunctionM {
  int m = 1;
  Join join = Join::intersect;
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::RFunction>();
template <>
const Op& op_for<detail::RFunctionM>();
}  // namespace blendwright
