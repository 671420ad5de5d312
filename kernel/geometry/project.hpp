#pragma once
// Closest points: own damped Newton with grid seeds, periodic parameters wrapped.
#include <optional>

#include "kernel/geometry/curve.hpp"
#include "kernel/geometry/surface.hpp"

namespace blendwright {

struct Foot {
  UV at;
  Vec3 point;
  double distance = 0.0;
  /// The residual is orthogonal to the surface (up to 1e-9 of the surface's size); false: the nearest point
  /// lies on the domain's border.
  bool interior = true;
};

/// Local minimum of |S - q| reached from `guess`; stays in an open domain. At most 50 steps (3 or 4 from a
/// near guess); the best point found is returned (never throws because of the geometry). A pole is left again
/// when it is no minimum.
[[nodiscard]] Foot closest_point(const Surface& surface, const Vec3& q, UV guess);
/// Global search: Newton from the best four local minima on a grid of 24 x 24 seeds.
[[nodiscard]] Foot closest_point(const Surface& surface, const Vec3& q);

/// Intersection of the line q + t direction (t of either sign) with the surface, by Newton from `guess` on
/// the part of S - q across the line; the line counts as met within 1e-12 of the size. Foot::distance is that
/// from q.
[[nodiscard]] std::optional<Foot> shoot(const Surface& surface, const Vec3& q, const Vec3& direction,
                                        UV guess);
/// The intersection with the smallest |t|, from grid seeds.
[[nodiscard]] std::optional<Foot> shoot(const Surface& surface, const Vec3& q, const Vec3& direction);

struct CurveFoot {
  double v = 0.0;
  Vec3 point;
  double distance = 0.0;
};
[[nodiscard]] CurveFoot closest_point(const Curve3& curve, const Vec3& q, double guess);

}  // namespace blendwright
