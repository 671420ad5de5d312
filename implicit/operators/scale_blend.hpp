#pragma once
// The scale method: B(x1, x2) = the h > 0 for which (x1, x2)/h lies on the blending curve of level 1, a conic
// of Hoffmann and Hopcroft (B_H of hoffmann.hpp) with the range of the blend in its radii.
//   lower  B_H(x1/h - 1, x2/h - 1) = 0   one-level union, half-level intersection     B <= min
//   upper  B_H(1 - x1/h, 1 - x2/h) = 0   one-level intersection, half-level union     B >= max
// r1, r2 > 0 (upper: <= 1), p < r1 r2 (1 - 1e-6). With k = +1 (lower) or -1 (upper), K_i = 1 + k r_i:
//   a h^2 + b h + c = 0,  a = (1 + 2 k r2) r1^2 + K1^2 r2^2 + 2 p,  b = -2 (x1 (K1 r2^2 + p) + x2 (K2 r1^2 +
//   p)), c = r1^2 x2^2 + r2^2 x1^2 + 2 p x1 x2,  the root with k (2 a h + b) > 0,
// in region III, between the lines x1 = K1 x2 and x2 = K2 x1; beyond them the smaller, or larger, argument.
// There
//   b^2/4 - a c = w (w (x1 - x2)^2 + 2 r1 r2 (x1 - K1 x2) (x2 - K2 x1)),  w = r1 r2 - p,
// a sum of terms that are not negative (derived; it makes the root accurate for p next to r1 r2).
// Rises in both arguments >= 0 with partials in [0, 1], homogeneous of degree 1, C1 but at (0, 0); lower is
// concave, upper convex. r_i bounds x_i: the blend leaves x2 = level at x1 = K1 level.
// Hsu and Lee 2003, with the second r1^2 of the printed coefficient a corrected to r2^2.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

enum class ScaleSide { lower, upper };

/// Of two arguments. Negative ones lie beyond region III.
struct ScaleBlend {
  double r1 = 1.0, r2 = 1.0, p = 0.0;
  ScaleSide side = ScaleSide::upper;
  double k1, k2, b1, b2, a;  ///< K1, K2, b = -2 (b1 x1 + b2 x2)
  ScaleBlend(double r1, double r2, double p, ScaleSide side);
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::ScaleBlend>();
}  // namespace blendwright
