#pragma once
// Points on the surface of a scene, with noise: what a scanner gives.
#include <numbers>
#include <optional>
#include <vector>

#include "implicit/scene/scene.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {

struct ScanOptions {
  std::size_t points = 2000;
  double noise = 0.0;               ///< standard deviation of each coordinate, model units
  std::optional<Vec3> seen_from{};  ///< only points whose normal looks that way
};

/// Three standard normal numbers (Box and Muller).
inline Vec3 normal3(Rng& rng) {
  std::array<double, 4> z{};
  for (std::size_t i = 0; i < 4; i += 2) {
    const double r = std::sqrt(-2.0 * std::log(uniform(rng, 1e-300, 1.0))),
                 a = uniform(rng, 0.0, 2.0 * std::numbers::pi);
    z[i] = r * std::cos(a);
    z[i + 1] = r * std::sin(a);
  }
  return {z[0], z[1], z[2]};
}

/// Along random rays from `centre`, which lies inside: the surface is found by bisection of the scene's own
/// field.
inline std::vector<Vec3> scan(const SceneSpec& spec, const Vec3& centre, double reach,
                              const ScanOptions& options, Rng& rng) {
  const Scene scene = build_scene(spec);
  const auto inside = [&](const Vec3& p) {
    return blendwright::inside(scene.field.level(), scene.field.value(p)) > 0.0;
  };
  std::vector<Vec3> points;
  while (points.size() < options.points) {
    const Vec3 direction = normal3(rng).normalized();
    if (options.seen_from && direction.dot(*options.seen_from) < 0.0) continue;
    double lo = 0.0, hi = reach;
    for (int i = 0; i < 60; ++i) {
      const double mid = 0.5 * (lo + hi);
      (inside(centre + mid * direction) ? lo : hi) = mid;
    }
    const Vec3 noise = normal3(rng);
    points.push_back(centre + lo * direction + options.noise * noise);
  }
  return points;
}

inline NodeSpec node(std::string name, std::string kind, std::map<std::string, NodeValue> values) {
  return {.name = std::move(name), .kind = std::move(kind), .values = std::move(values)};
}

/// A superquadric somewhere, turned somehow.
inline SceneSpec placed_superquadric(const std::array<double, 5>& form, const Vec3& move, const Vec3& axis,
                                     double turn_deg) {
  SceneSpec spec;
  spec.nodes = {node("form", "superquadric",
                     {{"a", form[0]}, {"b", form[1]}, {"c", form[2]}, {"n1", form[3]}, {"n2", form[4]}}),
                node("body", "place",
                     {{"of", NodeRef{"form"}},
                      {"move", std::vector<double>{move.x(), move.y(), move.z()}},
                      {"axis", std::vector<double>{axis.x(), axis.y(), axis.z()}},
                      {"turn_deg", turn_deg}})};
  spec.solid = "body";
  return spec;
}

inline double number_of(const SceneSpec& spec, const std::string& name, const std::string& key) {
  for (const NodeSpec& n : spec.nodes)
    if (n.name == name) return std::get<double>(n.values.at(key));
  throw std::logic_error("no node " + name);
}

}  // namespace blendwright::test
