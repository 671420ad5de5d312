#pragma once
// Half of space and layers of it, by the plane X.n = 0; n: unit normal, a > 0: the distance from the plane at
// which the value is 1 (model units); X in R^3.
//   plane       f = (X.n)/a          signed, so not a distance; its gradient is n/a everywhere
//   half_space  d = max(0, X.n)/a    ray-linear; 0 on the half of space that n points away from
//   slab        d = |X.n|/a          ray-linear; gradient 0 on X.n = 0, where it does not exist
// Ricci 1973. Ranges exact: a linear form over a box, then the maximum with 0 or the magnitude.
// Erratum: the printed plane is called a map to [0, inf) although it is signed; slab and half_space are.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

struct Plane {
  Vec3 normal;  ///< n/a
};
struct HalfSpace {
  Vec3 normal;  ///< n/a
};
struct Slab {
  Vec3 normal;  ///< n/a
};

/// The values of X.v over a box, with what rounding can add.
[[nodiscard]] Range linear_range(const Vec3& v, const Box& box);

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::Plane>();
template <>
const Op& op_for<detail::HalfSpace>();
template <>
const Op& op_for<detail::Slab>();
}  // namespace blendwright
