#pragma once
// Turns and moves of bodies.
#include "kernel/field/scalar_field.hpp"
#include "kernel/geometry/rigid_motion.hpp"

namespace blendwright {

/// The motion that takes motion(X) back to X.
[[nodiscard]] inline RigidMotion inverse(const RigidMotion& motion) {
  return {motion.R.transpose(), -(motion.R.transpose() * motion.t)};
}

/// The field of the moved body: at X it is `field` at R^T (X - t). Its bounds are those of the moved box, its
/// members keep their names. Throws InputError ("motion") when a number is not finite or R is no rotation (to
/// 1e-9).
[[nodiscard]] ScalarField placed(const ScalarField& field, const RigidMotion& motion);

}  // namespace blendwright
