#pragma once
// Hoffmann and Hopcroft's quadratic blend of two zero-level fields.
//   B_H(y1, y2) = r2^2 y1^2 + r1^2 y2^2 + r1^2 r2^2 - 2 r2^2 r1 y1 - 2 r1^2 r2 y2 + 2 p y1 y2
// r1, r2 > 0; p < r1 r2. B_H = 0 touches y2 = 0 at (r1, 0) and y1 = 0 at (0, r2); between them it is the
// blend. As a field the displacement form is used (Rockwood 1989): union(x1, x2) = min where |x1 - x2|
// reaches r1 (x1 larger) or r2 (x2 larger), else the h with B_H(x1 - h, x2 - h) = 0. With t = min - h >= 0, d
// = |x1 - x2|, w = r1 r2 - p:
//   ((r1 + r2) t - e)^2 = 2 w t (d + t),  e = r2 (r1 - d) where x2 is the smaller, else r1 (r2 - d),
// whose solution is a quotient of terms >= 0 (derived): accurate for every p. Partials g_i/(g1 + g2) with
// g_i, k of arc-inl.hpp; second derivatives K, -K, K (xx, xy, yy), K = -k/(g1 + g2)^3. Intersection -U(-x1,
// -x2), difference -U(-x1, x2). C1; partials in [0, 1] with sum 1 (so Lipschitz 1 in the max norm); union <=
// min. Hoffmann and Hopcroft 1985, 1987.
#include "implicit/operators/log_sum_exp.hpp"

namespace blendwright::detail {

/// B_H itself: a curve, not a field of a solid.
struct HoffmannPolynomial {
  double r1 = 1.0, r2 = 1.0, p = 0.0;
};

/// Of two arguments.
struct HoffmannBlend {
  double r1, r2;
  ZeroRole role;
  double w;
  HoffmannBlend(double r1, double r2, double p, ZeroRole role);
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::HoffmannPolynomial>();
template <>
const Op& op_for<detail::HoffmannBlend>();
}  // namespace blendwright
