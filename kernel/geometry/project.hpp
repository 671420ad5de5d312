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
  bool interior = true;  ///< the residual is orthogonal to the surface; false: the nearest point lies on the domain's border
};

/// Local minimum of |S - q| reached from `guess`; stays in an open domain. At most 50 steps; the best point found is
/// returned (never throws because of the geometry).
[[nodiscard]] Foot closest_point(const Surface& surface, const Vec3& q, UV guess);
/// Global search: grid of seeds (both ends of a closed direction included), Newton from the best few.
[[nodiscard]] Foot closest_point(const Surface& surface, const Vec3& q);

/// Intersection of the line q + t direction with the surface nearest to `guess`, by Newton on (u, v, t).
[[nodiscard]] std::optional<Foot> shoot(const Surface& surface, const Vec3& q, const Vec3& direction, UV guess);
/// The intersection with the smallest |t|, from grid seeds.
[[nodiscard]] std::optional<Foot> shoot(const Surface& surface, const Vec3& q, const Vec3& direction);

struct CurveFoot {
  double v = 0.0;
  Vec3 point;
  double distance = 0.0;
};
[[nodiscard]] CurveFoot closest_point(const Curve3& curve, const Vec3& q, double guess);

}  // namespace blendwright
