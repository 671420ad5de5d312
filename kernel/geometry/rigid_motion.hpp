#pragma once
// Rigid placement of surfaces.
#include <Eigen/Core>

#include "kernel/geometry/surface.hpp"

namespace blendwright {

/// x -> R x + t with R orthonormal, det R = +1.
struct RigidMotion {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Vec3 t = Vec3::Zero();
  [[nodiscard]] Vec3 operator()(const Vec3& x) const { return R * x + t; }
  [[nodiscard]] bool is_identity() const { return R.isIdentity(0.0) && t.isZero(0.0); }
  /// Takes the local z axis to `direction` at `origin`; local x goes to the part of `x_direction`
  /// perpendicular to it (a stable choice when x_direction is zero: the identity's x axis if it is not
  /// parallel to `direction`). Throws InputError when `direction` is zero or parallel to a given x_direction.
  [[nodiscard]] static RigidMotion from_axis(const Vec3& origin, const Vec3& direction,
                                             const Vec3& x_direction = Vec3::Zero());
};

/// A surface moved rigidly. `shape` is the surface in local coordinates: exporters look through the
/// placement.
struct PlacedSurface {
  Surface shape;
  RigidMotion motion;
  [[nodiscard]] SurfaceJet jet(UV p) const;
  [[nodiscard]] SurfacePartials partials(UV p) const;
  [[nodiscard]] SurfaceDomain domain() const { return shape.domain(); }
  void enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const;
};

/// `shape` itself when the motion is the identity, else a PlacedSurface (placements of placements are
/// merged).
[[nodiscard]] Surface placed(const Surface& shape, const RigidMotion& motion);

}  // namespace blendwright
