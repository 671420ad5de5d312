#pragma once
// Turns and moves of bodies.
#include "kernel/field/scalar_field.hpp"

namespace blendwright {

/// X -> turn X + move; turn is a rotation.
struct RigidMotion {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 move = Vec3::Zero();
  [[nodiscard]] Vec3 operator()(const Vec3& x) const { return turn * x + move; }
  [[nodiscard]] RigidMotion inverse() const { return {turn.transpose(), -(turn.transpose() * move)}; }
  bool operator==(const RigidMotion&) const = default;
};

/// The field of the moved body: placed(f, m) at m(X) is f at X. Its bounds are those of the moved box.
[[nodiscard]] ScalarField placed(const ScalarField& field, const RigidMotion& motion);

}  // namespace blendwright
