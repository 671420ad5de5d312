#include "tests/implicit/primitives/solid_samples.hpp"

#include "tests/implicit/support/scene_parts.hpp"
#include "tests/support/golden_folder.hpp"
#include "tests/support/relation_golden.hpp"

namespace blendwright::test {
namespace {

using List = std::vector<double>;

const Box two{Vec3::Constant(-2.0), Vec3::Constant(2.0)};

SolidSample one(const char* id, const char* kind, const Box& box, Values values) {
  return {id, kind, scene_of({part("case", kind, std::move(values))}), box};
}

NodeSpec ellipsoid(const char* name, double a, double b, double c) {
  return part(name, "ellipsoid_quadric", {{"a", a}, {"b", b}, {"c", c}});
}

/// Bumps of quadrics, of a distance and of a placed quadric, on a base that is no quadric.
SolidSample mixed_freeform() {
  return {
      "mixed-freeform", "freeform",
      scene_of(
          {part("base", "box", {{"half", List{1.0, 0.8, 0.6}}}), ellipsoid("unit", 0.7, 0.5, 0.4),
           part("ring", "torus", {{"ring", 0.9}, {"tube", 0.3}}),
           part("turned", "place", {{"of", ref("unit")}, {"move", List{1.0, 0.5, 0.2}}, {"turn_deg", 30.0}}),
           part("bump", "perturbation", {{"of", ref("turned")}, {"weight", 0.7}, {"power", 2.0}}),
           part("groove", "perturbation", {{"of", ref("ring")}, {"weight", -9.0}, {"power", 4.0}}),
           part("dent", "perturbation", {{"of", ref("unit")}, {"weight", -0.4}, {"free_term", -0.2}}),
           part("moved", "place", {{"of", ref("dent")}, {"move", List{-0.9, 0.1, 0.5}}}),
           part("case", "freeform", {{"base", ref("base")}, {"bumps", refs({"bump", "groove", "moved"})}})}),
      two};
}

SolidSample bumps_without_base() {
  return {"metaballs", "freeform",
          scene_of({ellipsoid("a", 1.0, 0.8, 0.8),
                    part("b", "place", {{"of", ref("a")}, {"move", List{1.0, 0.3, 0.0}}}),
                    part("r1", "perturbation", {{"of", ref("a")}}),
                    part("r2", "perturbation", {{"of", ref("b")}}),
                    part("case", "freeform", {{"bumps", refs({"r1", "r2"})}})}),
          two};
}

std::vector<SolidSample> all_samples() {
  std::vector<SolidSample> all;
  for (const RelationCase& c : read_relation_golden(golden_folder()))
    if (c.function == "quadric" || c.function == "perturbation" || c.function == "freeform" ||
        c.function.starts_with("signed_distance_"))
      all.push_back({c.id, c.scene.nodes.back().kind, c.scene, two});
  const Box four{Vec3::Constant(-4.0), Vec3::Constant(4.0)};
  all.push_back(one("ellipsoid-quadric", "ellipsoid_quadric", four, {{"a", 3.0}, {"b", 2.0}, {"c", 1.0}}));
  all.push_back(one("cylinder", "quadric", two, {{"coefficients", List{-1, -1, 0, 0, 0, 0, 0, 0, 0, 1}}}));
  all.push_back(one("half-space", "quadric", two, {{"coefficients", List{0, 0, 0, 0, 0, 0, 1, 2, 3, -1}}}));
  all.push_back(one("ellipsoid-3-2-1", "ellipsoid", four, {{"a", 3.0}, {"b", 2.0}, {"c", 1.0}}));
  all.push_back(one("disc", "ellipsoid", two, {{"a", 1.0}, {"b", 1.0}, {"c", 0.01}}));
  all.push_back(one("needle", "ellipsoid", two, {{"a", 0.05}, {"b", 0.05}, {"c", 1.5}}));
  all.push_back(one("ball-as-ellipsoid", "ellipsoid", two, {{"a", 1.2}, {"b", 1.2}, {"c", 1.2}}));
  all.push_back(one("nearly-a-ball", "ellipsoid", two, {{"a", 1.0}, {"b", 1.0 + 1e-12}, {"c", 1.0 + 1e-6}}));
  all.push_back(one("thin-torus", "torus", two, {{"ring", 1.5}, {"tube", 0.01}}));
  all.push_back(one("plate", "box", two, {{"half", List{1.5, 1.0, 0.01}}}));
  all.push_back(mixed_freeform());
  all.push_back(bumps_without_base());
  return all;
}

}  // namespace

const std::vector<SolidSample>& solid_samples() {
  static const std::vector<SolidSample> all = all_samples();
  return all;
}

}  // namespace blendwright::test
