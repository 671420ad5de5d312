// Operators of level function as solids: closed meshes, of the right volume.
#include <gtest/gtest.h>

#include "implicit/polygonize/polygonize.hpp"
#include "implicit/scene/scene.hpp"
#include "tests/implicit/support/scene_parts.hpp"
#include "tests/support/golden_folder.hpp"
#include "tests/support/relation_golden.hpp"

namespace blendwright::test {
namespace {

using Numbers = std::vector<double>;

FieldMesh mesh_of(const Scene& scene, double cell, std::optional<Box> box = std::nullopt) {
  MeshOptions options;
  options.cell = cell;
  options.box = box;
  return polygonize(scene.field, options);
}

/// The box [-half, half] as six planes, all edges and corners rounded at once: with w = 2 and one reach an
/// edge is a cylinder and a corner a ball.
SceneSpec rounded_box(const Vec3& half, double r) {
  SceneSpec scene;
  std::vector<std::string> names;
  for (int side = 0; side < 6; ++side) {
    Numbers a(10);
    a[static_cast<std::size_t>(6 + side / 2)] = side % 2 == 0 ? 1.0 : -1.0;
    a[9] = half[side / 2];
    names.push_back("side " + std::to_string(side));
    scene.nodes.push_back(part(names.back(), "quadric", {{"coefficients", a}}));
  }
  scene.nodes.push_back(
      part("x", "rockwood_intersection", {{"of", refs(names)}, {"r", Numbers{r}}, {"w", 2.0}}));
  scene.solid = "x";
  return scene;
}

/// The golden openings of a box by a ball have the sign of its six planes' blend.
TEST(Rockwood, OfSixPlanesIsTheOpeningOfABox) {
  int seen = 0, inside = 0;
  for (const RelationCase& c : read_relation_golden(golden_folder())) {
    if (c.function != "opening_of_box") continue;
    const std::vector<double>& half = c.parameters.lists.at("half");
    const Scene scene = build_scene(rounded_box({half[0], half[1], half[2]}, c.parameters.numbers.at("r")));
    for (const RelationSample& s : c.samples) {
      EXPECT_EQ(scene.field.value({s.x()[0], s.x()[1], s.x()[2]}) > 0.0, s.value() > 0.0);
      ++seen;
      if (s.value() > 0.0) ++inside;
    }
  }
  EXPECT_GE(seen, 8);
  EXPECT_GT(inside, 0);
  EXPECT_LT(inside, seen);
}

/// By Steiner's formula the opening of the box (1, 0.8, 0.6) by 0.2 has the volume 3.68589966375522. A face
/// lies at most 3 h^2/(8 r) below the curved part, whose area is 2 pi r (1.6 + 1.2 + 0.8) + 4 pi r^2 at most.
TEST(Rockwood, OfSixPlanesHasTheVolumeOfTheOpening) {
  const double h = 0.025;
  // Planes have no bounds.
  const FieldMesh made =
      mesh_of(build_scene(rounded_box({1.0, 0.8, 0.6}, 0.2)), h, Box{{-1.1, -0.9, -0.7}, {1.1, 0.9, 0.7}});
  EXPECT_TRUE(find_defects(made.mesh, h).none());
  EXPECT_NEAR(made.facts.volume, 3.68589966375522, 3.0 * h * h / 1.6 * 5.1);
}

/// Two balls at a distance of 1.2, and a node of both: bounded, closed, of one piece.
TEST(FunctionKinds, HaveClosedMeshes) {
  const Values none{};
  const Numbers r{0.4}, a3{0.15, 0.4, 0.4}, a4{0.15, 0.4, 0.4, 0.4};
  const std::vector<std::pair<std::string, Values>> kinds{
      {"r_union", {{"alpha", 0.5}}},
      {"r_intersection", none},
      {"r0m_union", {{"m", 1.0}}},
      {"ricci_union_function", {{"n", 8.0}}},
      {"ricci_difference_function", {{"n", 12.0}}},
      {"liming_clipped", {{"c_a", 1.0}, {"c_b", 1.0}, {"r", 0.4}}},
      {"rockwood_union", {{"r", r}}},
      {"rockwood_intersection", {{"r", r}, {"w", 3.0}}},
      {"rockwood_difference", {{"r", r}, {"w", 1.5}}},
      {"rockwood_raw", {{"r", r}}},
      {"pasko_savchenko_union", {{"a", a3}}},
      {"bounded_blend_union", {{"a", a4}, {"within", ref("half")}}},
      {"local_blend", {{"r", r}, {"around", ref("half")}, {"fade", 0.2}}},
  };
  double sharp = 0.0;
  for (const auto& [kind, given] : kinds) {
    SCOPED_TRACE(kind);
    Values values = given;
    values["of"] = refs({"left", "right"});
    const auto built = [&](const std::string& name, const Values& v) {
      return build_scene(
          scene_of({part("ball", "sphere", {{"radius", 1.0}}),
                    part("left", "place", {{"of", ref("ball")}, {"move", Numbers{-0.6, 0, 0}}}),
                    part("right", "place", {{"of", ref("ball")}, {"move", Numbers{0.6, 0, 0}}}),
                    part("half", "quadric", {{"coefficients", Numbers{0, 0, 0, 0, 0, 0, 0, 1, 0, 0}}}),
                    part("x", name, v)}));
    };
    const double cell = 0.06;
    if (sharp == 0.0) sharp = mesh_of(built("max", {{"of", values["of"]}}), cell).facts.volume;
    const Scene scene = built(kind, values);
    ASSERT_TRUE(scene.field.bounds());
    const FieldMesh made = mesh_of(scene, cell);
    EXPECT_TRUE(find_defects(made.mesh, cell).none());
    EXPECT_FALSE(made.facts.cut_by_box);
    EXPECT_EQ(made.facts.components, 1u);
    EXPECT_EQ(made.facts.euler_characteristic, 2);
    // R-functions have the sharp union; every blend of a union adds material.
    if (kind.starts_with("r_union") || kind.starts_with("r0m")) {
      EXPECT_NEAR(made.facts.volume, sharp, 0.01);
    } else if (kind.ends_with("union") || kind == "local_blend" || kind == "liming_clipped") {
      EXPECT_GT(made.facts.volume, sharp + 0.01);
    }
  }
}

}  // namespace
}  // namespace blendwright::test
