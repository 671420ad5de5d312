#pragma once
// Bodies of the benchmarks of relations: convex ones with planted gaps, freeforms, and crowds that move.
#include <string>
#include <vector>

#include "implicit/relations/moving_bodies.hpp"
#include "kernel/field/rigid_motion.hpp"
#include "tests/bench/field_models.hpp"
#include "tests/bench/numbers.hpp"

namespace blendwright::bench {

enum class Shape { sphere, ellipsoid, box };
/// A convex body: semi-axes or half sizes (a sphere: three times its radius), and where it is.
struct Convex {
  Shape shape = Shape::sphere;
  Vec3 size = Vec3::Ones();
  RigidMotion at;
  /// Around the origin; spheres and ellipsoids as quadrics, boxes as exact distances.
  [[nodiscard]] ScalarField field() const;
  /// The point farthest along a direction.
  [[nodiscard]] Vec3 support(const Vec3& direction) const;
};
/// A random pair whose points of support along a random direction stand `gap` apart: that is their distance
/// for gap >= 0, for they have a slab between them; for a small gap < 0 they are in each other.
struct Pair {
  Convex first, second;
};
[[nodiscard]] Pair planted_pair(Numbers& numbers, Shape shape, double gap);

/// About as large as a ball of radius 1, with `bumps` perturbations.
[[nodiscard]] ScalarField freeform(std::size_t bumps, std::uint64_t seed);

/// Bodies that move straight and turn in a box, whose walls they bounce off.
class Crowd {
 public:
  Crowd(std::size_t count, double half_box, std::uint64_t seed);
  [[nodiscard]] const std::vector<RigidMotion>& placements() const { return placements_; }
  /// Each moves by `length` and turns by as many radians, on average.
  void step(double length);

 private:
  double half_box_;
  std::vector<RigidMotion> placements_;
  std::vector<Vec3> velocity_, spin_;
};

}  // namespace blendwright::bench
