#pragma once
// Hoffmann and Hopcroft's quadratic blend of two zero-level fields.
//   B_H(y1, y2) = r2^2 y1^2 + r1^2 y2^2 + r1^2 r2^2 - 2 r2^2 r1 y1 - 2 r1^2 r2 y2 + 2 p y1 y2
// r1, r2 > 0; p < r1 r2 (1 - 1e-6). B_H = 0 touches y2 = 0 at (r1, 0) and y1 = 0 at (0, r2); between them it
// is the blend. As a field the displacement form is used (Rockwood 1989): union(x1, x2) = min where |x1 - x2|
// reaches r1 (x1 larger) or r2 (x2 larger), else the h with B_H(x1 - h, x2 - h) = 0. With y_i = x_i - min,
// h' = h - min solves a h'^2 + b h' + c = 0, the root with 2 a h' + b = sqrt(b^2 - 4 a c) > 0:
//   a = r1^2 + r2^2 + 2 p, b = 2 r1 r2 (r1 + r2) - 2 r2^2 y1 - 2 r1^2 y2 - 2 p (y1 + y2), c = B_H(y1, y2).
// Intersection -U(-x1, -x2), difference -U(-x1, x2). C1; partials in [0, 1] with sum 1 (so Lipschitz 1 in the
// max norm), second derivatives k, -k, k (xx, xy, yy); union <= min. Hoffmann and Hopcroft 1985, 1987.
#include "implicit/operators/log_sum_exp.hpp"

namespace blendwright::detail {

/// B_H itself: a curve, not a field of a solid.
struct HoffmannPolynomial {
  double r1 = 1.0, r2 = 1.0, p = 0.0;
};

/// Of two arguments.
struct HoffmannBlend {
  double r1 = 1.0, r2 = 1.0, p = 0.0;
  ZeroRole role = ZeroRole::make_union;
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::HoffmannPolynomial>();
template <>
const Op& op_for<detail::HoffmannBlend>();
}  // namespace blendwright
