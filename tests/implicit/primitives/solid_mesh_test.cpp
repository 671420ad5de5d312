// Solids as meshes: closed, within their bounds, of the right volume.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "implicit/polygonize/polygonize.hpp"
#include "implicit/scene/scene.hpp"
#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright::test {
namespace {

using List = std::vector<double>;
constexpr double pi = std::numbers::pi;

FieldMesh mesh_of(const Scene& scene, double cell) {
  MeshOptions options;
  options.cell = cell;
  return polygonize(scene.field, options);
}

/// `bend`: the least radius of curvature, 0 for flat faces. Between vertices on the surface, at most h
/// sqrt(3) apart, a face lies at most 3 h^2 / (8 bend) below the surface.
void expect_volume(const NodeSpec& solid, double volume, double area, double bend) {
  SCOPED_TRACE(solid.kind);
  const double h = 0.05;
  const FieldMesh made = mesh_of(build_scene(scene_of({solid})), h);
  EXPECT_TRUE(find_defects(made.mesh, h).none());
  EXPECT_FALSE(made.facts.cut_by_box);
  // Edges of a box are cut off by at most half a cell's square along their length, 12 edges of at most 3.
  const double slack = bend > 0.0 ? 3.0 * h * h / (8.0 * bend) * area : 0.5 * h * h * 36.0;
  EXPECT_NEAR(made.facts.volume, volume, slack);
}

TEST(SolidMeshes, HaveTheVolumesOfTheirSolids) {
  expect_volume(part("s", "sphere", {{"radius", 1.0}}), 4.0 * pi / 3.0, 4.0 * pi, 1.0);
  expect_volume(part("s", "torus", {{"ring", 1.0}, {"tube", 0.4}}), 2.0 * pi * pi * 0.16, 4.0 * pi * pi * 0.4,
                0.4);
  // Least radius of curvature c^2/a, area less than that of the box around it.
  const Values axes{{"a", 1.5}, {"b", 1.2}, {"c", 1.0}};
  for (const char* kind : {"ellipsoid", "ellipsoid_quadric"})
    expect_volume(part("s", kind, axes), 4.0 * pi / 3.0 * 1.8, 8.0 * (1.8 + 1.5 + 1.2), 1.0 / 1.5);
  expect_volume(part("s", "box", {{"half", List{1.0, 0.8, 0.6}}}), 8.0 * 0.48, 0.0, 0.0);
}

/// A sphere with a bump of the radius 0.5 around (1, 0, 0), k = 2: it reaches to x = 1.2124557763288396 for
/// w = 0.7 and semi-axes 0.5, 0.35, 0.35.
TEST(SolidMeshes, OfAFreeformReachAsFarAsTheBump) {
  const double x2 = 4.0, yz2 = 1.0 / (0.35 * 0.35);
  const auto freeform = [&](double power) {
    return scene_of(
        {part("base", "ellipsoid_quadric", {{"a", 1.0}, {"b", 1.0}, {"c", 1.0}}),
         part("q", "quadric", {{"coefficients", List{-x2, -yz2, -yz2, 0, 0, 0, 2 * x2, 0, 0, 1 - x2}}}),
         part("bump", "perturbation", {{"of", ref("q")}, {"weight", 0.7}, {"power", power}}),
         part("case", "freeform", {{"base", ref("base")}, {"bumps", refs({"bump"})}})});
  };
  for (const auto& [power, extent] : {std::pair{2.0, 1.2124557763288396}, {3.0, 1.1947226544500175}}) {
    const Scene scene = build_scene(freeform(power));
    EXPECT_NEAR(scene.field.value({extent, 0, 0}), 0.0, 1e-14);
    const FieldMesh made = mesh_of(scene, 0.04);
    EXPECT_TRUE(find_defects(made.mesh, 0.04).none());
    EXPECT_EQ(made.facts.components, 1u);
    EXPECT_EQ(made.facts.euler_characteristic, 2);
    EXPECT_GT(made.facts.volume, 4.0 * pi / 3.0);
  }
}

}  // namespace
}  // namespace blendwright::test
