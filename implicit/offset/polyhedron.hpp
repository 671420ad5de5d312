#pragma once
// The exact distance of an intersection of half-spaces n_i.X + c_i >= 0 (unit normals n_i, inward):
//   inside   d = min (n_i.X + c_i)
//   outside  d = -max |sum l_i n_i| over sets of up to three planes with l >= 0,                          (1)
//            (n_i.n_j) l = -(n_i.X + c_i), the distances to their common points
// (1) is the dual of the projection: each set gives a lower bound of the distance, the right one gives it.
#include <memory>
#include <optional>
#include <vector>

#include "implicit/eval/op.hpp"

namespace blendwright::detail {

struct HalfSpace {
  Vec3 normal;
  double offset;
};

/// value = sign * d + shift.
struct PolyhedronDistance {
  std::vector<HalfSpace> planes;
  double sign = 1.0, shift = 0.0;
};
inline constexpr std::size_t most_planes = 16;

/// d, without sign and shift.
struct PolyhedronPoint {
  double distance = 0.0;
  Vec3 gradient = Vec3::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};
[[nodiscard]] PolyhedronPoint polyhedron_point(const std::vector<HalfSpace>& planes, const Vec3& x);
/// Whether no point lies in all half-spaces.
[[nodiscard]] bool empty(const std::vector<HalfSpace>& planes);

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::PolyhedronDistance>();
}  // namespace blendwright
