// Meshes of offsets of constant radius lie on the exact offset; time of one of a freeform with twenty bumps.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "implicit/polygonize/polygonize.hpp"
#include "implicit/scene/scene.hpp"
#include "tests/implicit/offset/offset_samples.hpp"
#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright::test {
namespace {

using List = std::vector<double>;

FieldMesh mesh_of(const ScalarField& field, double cell) {
  MeshOptions options;
  options.cell = cell;
  return polygonize(field, options);
}

/// Vertices are `distance` away from the solid whose exact distance is the node `exact`; `of` is another
/// field of the same solid, or the same.
void expect_on_offset(const NodeSpec& of, const NodeSpec& exact, double distance) {
  SCOPED_TRACE(of.kind + " " + std::to_string(distance));
  const Scene scene = build_scene(
      scene_of({of, part("offset", "ball_offset", {{"of", ref(of.name)}, {"distance", distance}})}));
  const ScalarField d = build_scene(scene_of({exact})).field;
  const FieldMesh made = mesh_of(scene.field, 0.05);
  EXPECT_TRUE(find_defects(made.mesh, 0.05).none());
  EXPECT_FALSE(made.facts.cut_by_box);
  ASSERT_GT(made.mesh.points.size(), 1000u);
  const FieldValues f = d.evaluate(Order::value, made.mesh.points);
  double worst = 0.0;
  // Inside, the exact offset is where the distance is D: the nearest point of the surface is D away.
  for (std::size_t i = 0; i < made.mesh.points.size(); ++i)
    worst = std::max(worst, std::abs(f.value(i) + distance));
  EXPECT_LT(worst, 1e-6);
}

TEST(OffsetMeshes, LieOnTheExactOffset) {
  const Values axes{{"a", 1.2}, {"b", 0.9}, {"c", 0.7}};
  const NodeSpec ball = part("s", "sphere", {{"radius", 1.0}}), egg = part("s", "ellipsoid", axes),
                 egg_quadric = part("s", "ellipsoid_quadric", axes),
                 torus = part("s", "torus", {{"ring", 1.0}, {"tube", 0.4}}),
                 box = part("s", "box", {{"half", List{1.0, 0.8, 0.6}}}),
                 ball_quadric = part("s", "ellipsoid_quadric", {{"a", 1.0}, {"b", 1.0}, {"c", 1.0}});
  for (const double distance : {0.25, -0.25}) {
    expect_on_offset(ball, ball, distance);
    expect_on_offset(ball_quadric, ball, distance);
    expect_on_offset(egg, egg, distance);
    expect_on_offset(egg_quadric, egg, distance);
    expect_on_offset(torus, torus, distance);
  }
  expect_on_offset(box, box, 0.25);
}

/// Smaller boxes have edges, where vertices are held to 1e-2 cell only; elsewhere they are on the faces.
TEST(OffsetMeshes, OfASmallerBoxIsABox) {
  const Scene scene =
      build_scene(scene_of({part("s", "box", {{"half", List{1.0, 0.8, 0.6}}}),
                            part("offset", "ball_offset", {{"of", ref("s")}, {"distance", -0.25}})}));
  const ScalarField d = build_scene(scene_of({part("s", "box", {{"half", List{0.75, 0.55, 0.35}}})})).field;
  const FieldMesh made = mesh_of(scene.field, 0.04);
  const FieldValues f = d.evaluate(Order::value, made.mesh.points);
  for (std::size_t i = 0; i < made.mesh.points.size(); ++i) EXPECT_LT(std::abs(f.value(i)), 1e-6);
}

/// Printed: the time of a mesh at 1/64 of the size.
TEST(OffsetMeshes, OfAFreeformWithTwentyBumpsAreUsable) {
  SceneSpec spec = bumpy(20);
  spec.nodes.push_back(part("offset", "ball_offset", {{"of", ref("solid")}, {"distance", 0.1}}));
  spec.solid = "offset";
  spec.strict = false;
  const Scene scene = build_scene(spec);
  ASSERT_TRUE(scene.field.bounds());
  const int cells = std::getenv("BLENDWRIGHT_LONG") ? 64 : 20;
  const double cell = scene.field.bounds()->size().maxCoeff() / cells;
  const auto start = std::chrono::steady_clock::now();
  const FieldMesh made = mesh_of(scene.field, cell);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf(
      "ball offset of a freeform with 20 bumps, %d cells: %.2f s, %zu points evaluated, %zu vertices, %.1f "
      "us a point\n",
      cells, seconds, made.facts.evaluated_points, made.facts.vertices,
      1e6 * seconds / static_cast<double>(made.facts.evaluated_points));
  EXPECT_TRUE(find_defects(made.mesh, cell).none());
  EXPECT_LT(made.facts.largest_distance, 1e-2 * cell);
}

}  // namespace
}  // namespace blendwright::test
