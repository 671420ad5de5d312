#pragma once
// The scale method: B(x1, x2) = the h > 0 for which (x1, x2)/h lies on the blending curve of level 1, a conic
// of Hoffmann and Hopcroft (B_H of hoffmann.hpp) with the range of the blend in its radii.
//   lower  B_H(x1/h - 1, x2/h - 1) = 0   one-level union, half-level intersection     B <= min
//   upper  B_H(1 - x1/h, 1 - x2/h) = 0   one-level intersection, half-level union     B >= max
// r1, r2 > 0 (upper: <= 1), p < r1 r2. Blended in region III, between the lines x1 = K1 x2 and x2 = K2 x1,
// with k = +1 (lower) or -1 (upper) and K_i = 1 + k r_i; beyond them B is the smaller, or larger, argument.
// The printed quadratic for h (its coefficient a is (1 + 2 k r2) r1^2 + K1^2 r2^2 + 2 p) is solved for the
// distance t = |h - m| from the nearer argument m instead: with d = |x1 - x2| and w = r1 r2 - p
//   (sum t - e)^2 = 2 w t (d + t),  sum = r1 + r2 + k r1 r2,  e = r2 (r1 m - d) for m = x2, r1 (r2 m - d) for
//   m = x1,
// whose solution is a quotient of terms >= 0 (derived): accurate for every p. With y_i = |x_i - h| and g_i, k
// of arc-inl.hpp and N = g1 x1 + g2 x2: dh/dx_i = h g_i/N; h_11 = -K x2^2, h_12 = K x1 x2, h_22 = -K x1^2
// with K = +-h k/N^3, + for lower. Rises in both arguments >= 0 with partials in [0, 1], homogeneous of
// degree 1, C1 but at (0, 0); lower is concave, upper convex. r_i bounds x_i: the blend leaves x2 = level at
// x1 = K1 level. Hsu and Lee 2003.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

enum class ScaleSide { lower, upper };

/// Of two arguments. Negative ones lie beyond region III.
struct ScaleBlend {
  double r1, r2;
  ScaleSide side;
  double k1, k2, sum, w;
  ScaleBlend(double r1, double r2, double p, ScaleSide side);
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::ScaleBlend>();
}  // namespace blendwright
