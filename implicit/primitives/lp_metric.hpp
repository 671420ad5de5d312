#pragma once
// The L_p distance metric (super-ellipsoid): d = N_n(|x/a|, |y/b|, |z/c|), N_n the overflow-safe p-norm.
// a, b, c > 0: half-axes of d = 1 (model units); n > 0, convex for n >= 1, with cusps in the coordinate
// planes below 1; X in R^3. Blanc and Schlick 1995. Range exact: d rises with |x|, |y| and |z|. Erratum: a
// source calls these super-quadrics when it means this formula.
#include "implicit/eval/op.hpp"
#include "implicit/number/power.hpp"
#include "kernel/base/units.hpp"

namespace blendwright::detail {

struct LpMetric {
  Vec3 inverse_axes;  ///< 1/a, 1/b, 1/c
  Power n, inverse_n;
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::LpMetric>();
}  // namespace blendwright
