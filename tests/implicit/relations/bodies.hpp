#pragma once
// Bodies of the tests of relations, and pairs of them whose gap is known.
#include <string>
#include <vector>

#include "implicit/scene/scene.hpp"
#include "kernel/field/rigid_motion.hpp"
#include "tests/implicit/support/scene_parts.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {

/// A solid around the origin as nodes, and the point of it that is farthest along a direction.
struct Body {
  std::vector<NodeSpec> nodes;  ///< the last one is the solid
  std::function<Vec3(const Vec3& direction)> support;
  double reach = 0.0;  ///< it lies in the ball of this radius
};

[[nodiscard]] Body ball_body(double radius);                     ///< a quadric
[[nodiscard]] Body ellipsoid_body(const Vec3& semi_axes);        ///< a quadric
[[nodiscard]] Body exact_ellipsoid_body(const Vec3& semi_axes);  ///< an exact distance
[[nodiscard]] Body torus_body(double ring, double tube);
[[nodiscard]] Body box_body(const Vec3& half);     ///< an exact distance
[[nodiscard]] Body planes_body(const Vec3& half);  ///< the same box, the minimum of six half spaces
/// An ellipsoid (a, b, c) with bumps whose centres are on the x axis and dents and bumps at its sides, away
/// from its end: by symmetry its point farthest along x is on the axis. Only that support is known.
[[nodiscard]] Body freeform_body(Rng& rng);

/// The field of the body after `turn` and `move`, given by a node `place`.
[[nodiscard]] ScalarField field_of(const Body& body, const RigidMotion& at = {});

enum class Family { spheres, ellipsoids, exact_ellipsoids, tori, boxes, planes, freeforms };
inline constexpr Family families[] = {Family::spheres,  Family::ellipsoids, Family::exact_ellipsoids,
                                      Family::tori,     Family::boxes,      Family::planes,
                                      Family::freeforms};
[[nodiscard]] const char* name(Family family);

/// Two random bodies, turned and placed at random, between which a slab of thickness `gap` fits (gap > 0), or
/// whose ends reach past each other by -gap on one line (gap < 0, small): then they have a point in common.
struct PlantedPair {
  ScalarField first, second;
  Box domain;   ///< holds the first
  Vec3 middle;  ///< of the gap, or of what is in common
  Vec3 normal;  ///< from the first to the second
};
[[nodiscard]] PlantedPair planted_pair(Rng& rng, Family family, double gap);

/// 10^-9 to 10^-1.
[[nodiscard]] inline double random_gap(Rng& rng) {
  const double size = log_uniform(rng, 1e-9, 1e-1);
  return integer(rng, 0, 1) == 1 ? size : -size;
}

}  // namespace blendwright::test
