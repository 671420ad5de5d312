// Every solid of every example scene as a mesh: closed, on the surface, and of the right topology.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "implicit/polygonize/polygonize.hpp"
#include "tests/implicit/scenes/example_scene.hpp"

namespace blendwright::test {
namespace {

/// What is not one body without holes: number of bodies, Euler characteristic of the surface.
struct Topology {
  std::size_t components = 1;
  long euler_characteristic = 2;
};
Topology expected(const std::string& scene, const std::string& solid) {
  static const std::map<std::string, Topology> others = {
      {"s0-5b", {1, 0}},  // rings
      {"s3-offsets: ring+0.3", {1, 0}},
      {"s3-ring: wide-ring", {1, 0}},
      {"s3-ring: tight-ring", {1, 0}},
      {"s1-2", {1, -6}}};  // a wheel with four spokes' holes
  auto found = others.find(scene);
  if (found == others.end()) found = others.find(scene + ": " + solid);
  return found == others.end() ? Topology{} : found->second;
}

/// The largest distance of a vertex from the surface, to first order, in cells.
double largest_distance(const TriMesh& mesh, const ScalarField& field, double cell) {
  const FieldValues f = field.evaluate(Order::gradient, mesh.points);
  double largest = 0.0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const double away = std::abs(inside(field.level(), f.value(i)));
    if (away > 0.0) largest = std::max(largest, away / (f.gradient(i).norm() * cell));
  }
  return largest;
}

FieldMesh mesh_of(const ScalarField& field, double cell) {
  MeshOptions options;
  options.cell = cell;
  return polygonize(field, options);
}

class SceneMesh : public ::testing::TestWithParam<std::string> {};

TEST_P(SceneMesh, IsClosedAndOnTheSurface) {
  const ExampleScene scene(GetParam());
  ASSERT_FALSE(scene.solids().empty());
  for (const std::string& solid : scene.solids()) {
    SCOPED_TRACE("solid " + solid);
    const ScalarField field = scene.field(solid);
    ASSERT_TRUE(field.bounds().has_value());
    const double cell = field.bounds()->size().maxCoeff() / 56.0;
    const FieldMesh made = mesh_of(field, cell);
    EXPECT_FALSE(made.facts.cut_by_box);
    EXPECT_GT(made.facts.triangles, 1000u);
    const MeshDefects defects = find_defects(made.mesh, cell);
    EXPECT_TRUE(defects.none()) << defects.open_edges << " open, " << defects.overused_edges << " overused, "
                                << defects.flipped_edges << " flipped, " << defects.degenerate_faces
                                << " degenerate, " << defects.repeated_points << " repeated";
    const Topology topology = expected(GetParam(), solid);
    EXPECT_EQ(made.facts.components, topology.components);
    EXPECT_EQ(made.facts.euler_characteristic, topology.euler_characteristic);
    // Also at creases: they need no allowance.
    EXPECT_LE(largest_distance(made.mesh, field, cell), 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Examples, SceneMesh, ::testing::ValuesIn(example_scenes()), [](const auto& scene) {
  std::string name = scene.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(SceneMeshes, AreThereForEveryFigure) { EXPECT_EQ(example_scenes().size(), 51u); }

TEST(SceneBounds, ComeFromSlabsThatEncloseTheSolid) {
  for (const char* name : {"s0-4", "s2-1b"}) {
    const std::optional<Box> box = ExampleScene(name).field().bounds();
    ASSERT_TRUE(box.has_value());
    EXPECT_LE((box->hi - Vec3::Ones()).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LE((box->lo + Vec3::Ones()).cwiseAbs().maxCoeff(), 1e-9);
  }
  // Two slabs leave the third axis open.
  EXPECT_FALSE(ExampleScene("s0-8").field("arc").bounds().has_value());
}

TEST(SceneMeshDistances, SeeAVertexThatIsMoved) {
  const ScalarField field = ExampleScene("s1-3").field();
  const double cell = 0.5;
  FieldMesh made = mesh_of(field, cell);
  made.mesh.points[made.mesh.points.size() / 2] += Vec3::Constant(1e-4 * cell);
  EXPECT_GT(largest_distance(made.mesh, field, cell), 1e-5);
}

TEST(SceneMeshDefects, SeeAFaceThatIsMissing) {
  FieldMesh made = mesh_of(ExampleScene("s1-3").field(), 0.5);
  made.mesh.triangles.pop_back();
  EXPECT_EQ(find_defects(made.mesh, 0.5).open_edges, 3u);
}

}  // namespace
}  // namespace blendwright::test
