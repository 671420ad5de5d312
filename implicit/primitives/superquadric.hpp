#pragma once
// Superquadrics: d = N_n2(q, |z/c|), q = N_n1(|x/a|, |y/b|), N_n the overflow-safe p-norm.
// a, b, c > 0: half-axes of d = 1 (model units); n1, n2 > 0, convex when both are >= 1. X in R^3.
// Barr 1981, Tigges et al. 1999. Range exact: d rises with |x|, |y| and |z|. On the z axis the x and y
// components of the gradient are 0.
// Errata: n1, n2 > 1 is printed as a condition, but figures of the same source use n1 = 0.6. A printed
// (|x/10|^7 + |y/10|^7 + |z/25|^2)^(1/2) mixes exponents and is not ray-linear; read n1 = 7, n2 = 2.
#include "implicit/eval/op.hpp"
#include "implicit/number/power.hpp"
#include "kernel/base/units.hpp"

namespace blendwright::detail {

struct Superquadric {
  Vec3 inverse_axes;  ///< 1/a, 1/b, 1/c
  Power n1, inverse_n1, n2, inverse_n2;
};

/// d = N_n(u, v, w) with one half-axis for either sign of a coordinate: u = x/a+ for x >= 0, -x/a- for x < 0,
/// and so on. a+, a-, ... > 0 (model units), n > 0; C1 off the origin when n > 1. After Blanc and Schlick
/// 1995. Range exact: u, v and w are V-shaped, their largest values are at ends of the box.
struct AsymmetricSuperellipsoid {
  Vec3 inverse_plus, inverse_minus;  ///< 1/a+, 1/b+, 1/c+ and 1/a-, 1/b-, 1/c-
  Power n, inverse_n;
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::Superquadric>();
template <>
const Op& op_for<detail::AsymmetricSuperellipsoid>();
}  // namespace blendwright
