#pragma once
// Bodies that are moved in tests.
#include <cmath>
#include <string>

#include "implicit/relations/moving_bodies.hpp"
#include "tests/implicit/moving/motions.hpp"
#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright::test {

inline ScalarField ellipsoid(double a, double b, double c) {
  return build_scene(scene_of({part("ellipsoid", "ellipsoid_quadric", {{"a", a}, {"b", b}, {"c", c}})}))
      .field;
}
inline ScalarField box_body(const Vec3& half) {
  return build_scene(
             scene_of({part("box", "box", {{"half", std::vector<double>{half.x(), half.y(), half.z()}}})}))
      .field;
}
/// An ellipsoid with bumps and a dent.
inline ScalarField freeform(Rng& rng) {
  std::vector<NodeSpec> nodes{part("base", "ellipsoid_quadric", {{"a", 0.9}, {"b", 0.8}, {"c", 0.7}})};
  std::vector<std::string> bumps;
  for (int i = 0; i < 4; ++i) {
    const std::string id = std::to_string(i);
    const Vec3 at = 0.8 * random_vector(rng, 1.0).normalized();
    nodes.push_back(part("unit " + id, "ellipsoid_quadric",
                         {{"a", uniform(rng, 0.2, 0.5)}, {"b", uniform(rng, 0.2, 0.5)}, {"c", 0.4}}));
    nodes.push_back(part("at " + id, "place",
                         {{"of", ref("unit " + id)}, {"move", std::vector<double>{at.x(), at.y(), at.z()}}}));
    nodes.push_back(part("bump " + id, "perturbation",
                         {{"of", ref("at " + id)}, {"weight", i == 3 ? -0.5 : uniform(rng, 0.3, 0.8)}}));
    bumps.push_back("bump " + id);
  }
  nodes.push_back(part("body", "freeform", {{"base", ref("base")}, {"bumps", refs(bumps)}}));
  return build_scene(scene_of(std::move(nodes))).field;
}

/// Bodies on a random walk in a box: every step moves and turns each of them a little.
class Walk {
 public:
  Walk(Rng& rng, std::size_t count, double reach) : rng_(rng), reach_(reach) {
    for (std::size_t i = 0; i < count; ++i) now_.push_back(random_motion(rng, reach));
  }
  [[nodiscard]] const std::vector<RigidMotion>& now() const { return now_; }
  void step(double length) {
    for (RigidMotion& m : now_) {
      m.t += random_vector(rng_, length);
      m.t = m.t.cwiseMax(-reach_).cwiseMin(reach_);
      const Eigen::AngleAxisd turn(length, random_vector(rng_, 1.0).normalized());
      m.R = Eigen::Quaterniond(turn * Eigen::Quaterniond(m.R)).normalized().toRotationMatrix();
    }
  }

 private:
  Rng& rng_;
  double reach_;
  std::vector<RigidMotion> now_;
};

/// A pair and its verdict.
struct Found {
  std::size_t first, second;
  Contact contact;
  bool operator==(const Found&) const = default;
};
inline std::vector<Found> verdicts(const std::vector<BodyPair>& pairs) {
  std::vector<Found> found;
  for (const BodyPair& p : pairs) found.push_back({p.first, p.second, p.collision.contact});
  return found;
}
inline void PrintTo(const Found& f, std::ostream* out) {
  *out << f.first << '-' << f.second << ' ' << name(f.contact);
}

}  // namespace blendwright::test
