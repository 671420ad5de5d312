#pragma once
// How far a spline surface leaves the exact blend's tangent plane and normal curvature at a trimline.
#include <cmath>

#include <Eigen/Geometry>

#include "kernel/geometry/curvature.hpp"

namespace blendwright::detail {

struct TrimlineDefect {
  double angle = 0.0;  ///< between the tangent planes, radians
  double curvature =
      0.0;  ///< difference of the normal curvatures across the trimline (direction n x C'), 1/model unit
};

/// Both 0 where the exact blend is degenerate: such points are reported where the trimline is made.
[[nodiscard]] inline TrimlineDefect trimline_defect(const SurfaceJet& exact, const SurfaceJet& spline) {
  const Vec3 n = unit_normal(exact);
  if (n.isZero(0.0)) return {};
  const Vec3 across = n.cross(exact.Sv);
  const double k = normal_curvature(spline, across, n) - normal_curvature(exact, across, n);
  return {plane_angle(n, spline.Su.cross(spline.Sv)).value, std::abs(k)};
}

}  // namespace blendwright::detail
