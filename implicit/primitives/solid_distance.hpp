#pragma once
// Exact distances to the surface, positive inside, of a sphere, a torus, a box and an ellipsoid (level
// function; model units). Where the nearest point is not unique the value is exact and the gradient that of
// one nearest point, or 0.
//   sphere     f = R - |X|
//   torus      f = r - |(sqrt(x^2 + y^2) - R, z)|, around the z axis, 0 < r < R
//   box        f = -|max(a, 0)| - min(max a_i, 0), a_i = |x_i| - h_i
//   ellipsoid  f = -t |W|, W_i = x_i / (t + s_i^2), t the largest root of sum (s_i W_i)^2 = 1             (1)
// The nearest point of an ellipsoid is P_i = s_i^2 W_i and its outward normal W/|W|; t is negative inside.
// All but the torus are concave and fall with |x_i|.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

struct SphereDistance {
  double radius;
};
struct TorusDistance {
  double ring, tube;
};
struct BoxDistance {
  Vec3 half;
};
struct EllipsoidDistance {
  explicit EllipsoidDistance(const Vec3& semi_axes);
  Vec3 s;     ///< semi-axes
  Vec3 e;     ///< s_i^2 - s_min^2, without cancellation
  int least;  ///< the first axis with s = s_min
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::SphereDistance>();
template <>
const Op& op_for<detail::TorusDistance>();
template <>
const Op& op_for<detail::BoxDistance>();
template <>
const Op& op_for<detail::EllipsoidDistance>();
}  // namespace blendwright
