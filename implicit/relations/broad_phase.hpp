#pragma once
// Private: which of many bodies may touch, from their boxes alone.
#include <span>
#include <utility>
#include <vector>

#include "kernel/field/rigid_motion.hpp"

namespace blendwright::detail {

/// All pairs (i < j) of boxes that have a point in common, in their order. Boxes are finite.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> meeting_boxes(std::span<const Box> boxes);

/// A box that was turned: the points centre + axes t, |t_i| <= half_i.
struct OrientedBox {
  Vec3 centre = Vec3::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Vec3 half = Vec3::Zero();
  double uncertainty = 0.0;  ///< of the axes, relative: what rounding left of a rotation
};
/// Encloses the solid that `box` encloses, where the motion takes it.
[[nodiscard]] OrientedBox moved(const Box& box, const RigidMotion& motion);
/// Proof that they have no point in common: one of the 15 axes that can separate two boxes (Gottschalk, Lin
/// and Manocha 1996) does, by more than rounding. False: they may.
[[nodiscard]] bool apart(const OrientedBox& a, const OrientedBox& b);
/// Encloses what both have in common in `box`; nullopt: nothing.
[[nodiscard]] std::optional<Box> common_box(const Box& box, const OrientedBox& a, const OrientedBox& b);

}  // namespace blendwright::detail
