#pragma once
// A soft ellipsoid, the most frequent soft object, as one primitive: P(|y|), y the coordinates in which its
// influence region is the unit ball, P the potential of Blanc and Schlick. It needs u = |y|^2 only, no root:
//   u <= 1/4  P = 1 - 9 u^2 / D,     P' = -9 (u/D) (1 + k/D),        P'' = -18 k^2 / D^3,
//             D = s + (4.5 - 4 s) u,         k = s
//   u > 1/4   P = (1 - u)^2 / D,     P' = -((1 - u)/D) (1 + k/D),    P'' = 2 k^2 / D^3,
//             D = 0.75 - s + (1.5 + 4 s) u,  k = 2.25 + 3 s
// (derivatives by u), and exactly 0 for u >= 1. Tapes make these of a potential and an L_2 metric, and of the
// sum of a field and such an object.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

struct SoftEllipsoid {
  double softness = 0.0;
};
/// Its argument plus a soft ellipsoid.
struct AddedSoftEllipsoid {
  double softness = 0.0;
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::SoftEllipsoid>();
template <>
const Op& op_for<detail::AddedSoftEllipsoid>();
}  // namespace blendwright
