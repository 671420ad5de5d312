#pragma once
// Sweeps for tests.
#include <algorithm>
#include <numbers>

#include "tests/implicit/primitives/made_primitive.hpp"
#include "tests/implicit/support/scene_parts.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {

using Numbers = std::vector<double>;
using Texts = std::vector<std::string>;

inline NodeSpec round_profile(double radius) {
  return part("profile", "lp_profile", {{"a", radius}, {"b", radius}, {"n", 2.0}});
}
inline NodeSpec box_profile(double a, double b) {
  return part("profile", "lp_profile", {{"a", a}, {"b", b}, {"n", 4.0}});
}
inline NodeSpec star_profile(int k, double a) {
  return part("profile", "star", {{"k", static_cast<double>(k)}, {"a", a}, {"sigma", 0.7}, {"m", 2.0}});
}

/// A sweep of this kind along `trajectory` (its own keys), with cap 1 and m 2 unless they are among `values`.
inline SceneSpec sweep_scene(const NodeSpec& profile, const std::string& kind, Values values) {
  values.insert({{"profile", ref("profile")}, {"cap", 1.0}, {"m", 2.0}});
  return scene_of({profile, part("sweep", kind, std::move(values))});
}
inline MadePrimitive sweep(const NodeSpec& profile, const std::string& kind, Values values) {
  return make_primitive(sweep_scene(profile, kind, std::move(values)));
}

/// The first problem of a node, "where: message"; "" when it was made.
inline std::string problem_of(const MadePrimitive& made) {
  return made.problems.empty() ? "" : made.problems[0].where + ": " + made.problems[0].message;
}

/// The least distance over random points of the border of the node's region of `value`, a little enlarged.
inline double least_outside(const MadePrimitive& made, double value, int points) {
  Box box = *made.node.region(value);
  const Vec3 margin = 1e-3 * box.size();
  box = {box.lo - margin, box.hi + margin};
  Rng rng(9);
  std::vector<Vec3> border;
  for (int i = 0; i < points; ++i) {
    Vec3 p;
    for (int k = 0; k < 3; ++k) p[k] = uniform(rng, box.lo[k], box.hi[k]);
    p[i % 3] = i % 2 == 0 ? box.lo[i % 3] : box.hi[i % 3];
    border.push_back(p);
  }
  return std::ranges::min(values_at(*made.tape, border));
}

}  // namespace blendwright::test
