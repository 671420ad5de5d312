#pragma once
// Random motions.
#include <Eigen/Geometry>

#include "kernel/field/rigid_motion.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {

inline Vec3 random_vector(Rng& rng, double reach) {
  return {uniform(rng, -reach, reach), uniform(rng, -reach, reach), uniform(rng, -reach, reach)};
}
/// Even among all rotations (Shoemake 1992).
inline Eigen::Matrix3d random_turn(Rng& rng) {
  const double u = uniform(rng, 0.0, 1.0), v = uniform(rng, 0.0, 2.0 * M_PI),
               w = uniform(rng, 0.0, 2.0 * M_PI);
  const double a = std::sqrt(1.0 - u), b = std::sqrt(u);
  return Eigen::Quaterniond(b * std::cos(w), a * std::sin(v), a * std::cos(v), b * std::sin(w))
      .toRotationMatrix();
}
inline RigidMotion random_motion(Rng& rng, double reach) {
  return {random_turn(rng), random_vector(rng, reach)};
}
/// First b, then a.
inline RigidMotion after(const RigidMotion& a, const RigidMotion& b) { return {a.R * b.R, a(b.t)}; }

}  // namespace blendwright::test
