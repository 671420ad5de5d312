// Every defect that is planted in a sound mesh is found, and nothing else.
#include <gtest/gtest.h>

#include <cmath>

#include "implicit/polygonize/polygonize.hpp"
#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

TriMesh tetrahedron() {
  TriMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

MeshDefects defects_of(const TriMesh& mesh) { return find_defects(mesh, 1.0); }

TEST(Defects, ASoundMeshHasNone) { EXPECT_TRUE(defects_of(tetrahedron()).none()); }

TEST(Defects, AMissingFaceOpensItsThreeEdges) {
  TriMesh mesh = tetrahedron();
  mesh.triangles.pop_back();
  const MeshDefects d = defects_of(mesh);
  EXPECT_EQ(d.open_edges, 3u);
  EXPECT_EQ(d.overused_edges + d.flipped_edges + d.degenerate_faces + d.repeated_points, 0u);
}

TEST(Defects, ATurnedFaceFlipsItsThreeEdges) {
  TriMesh mesh = tetrahedron();
  std::swap(mesh.triangles[2][0], mesh.triangles[2][1]);
  const MeshDefects d = defects_of(mesh);
  EXPECT_EQ(d.flipped_edges, 3u);
  EXPECT_EQ(d.open_edges + d.overused_edges + d.degenerate_faces + d.repeated_points, 0u);
}

TEST(Defects, AThirdFaceAtAnEdgeOverusesIt) {
  TriMesh mesh = tetrahedron();
  mesh.points.push_back({1, 1, 1});
  mesh.triangles.push_back({0, 1, 4});
  const MeshDefects d = defects_of(mesh);
  EXPECT_EQ(d.overused_edges, 1u);
  EXPECT_EQ(d.open_edges, 2u);
}

TEST(Defects, FacesWithoutAreaAreDegenerate) {
  TriMesh twice_named = tetrahedron();
  twice_named.triangles[0] = {0, 2, 2};
  EXPECT_EQ(defects_of(twice_named).degenerate_faces, 1u);

  TriMesh flat = tetrahedron();
  flat.points[3] = {0.5, 0.0, 0.0};  // on the edge 0-1; the other faces keep area
  EXPECT_EQ(defects_of(flat).degenerate_faces, 1u);

  TriMesh lost = tetrahedron();
  lost.points[3].z() = NAN;
  EXPECT_EQ(defects_of(lost).degenerate_faces, 3u);
}

TEST(Defects, TheLeastAreaIsThatOfTheCell) {
  TriMesh small = tetrahedron();
  for (Vec3& p : small.points) p *= 1e-5;  // faces of 5e-11 and more
  EXPECT_EQ(find_defects(small, 1.0).degenerate_faces, 0u);
  EXPECT_EQ(find_defects(small, 7.0).degenerate_faces, 0u);   // 4.9e-11
  EXPECT_EQ(find_defects(small, 7.2).degenerate_faces, 3u);   // 5.2e-11; the oblique face has 8.7e-11
  EXPECT_EQ(find_defects(small, 10.0).degenerate_faces, 4u);  // 1e-10
}

TEST(Defects, PointsAtOnePlaceAreRepeated) {
  TriMesh mesh = tetrahedron();
  mesh.points.push_back(mesh.points[1]);
  mesh.triangles[1][1] = 4;  // the face hangs on the copy
  const MeshDefects d = defects_of(mesh);
  EXPECT_EQ(d.repeated_points, 1u);
  EXPECT_EQ(d.open_edges, 4u);
}

TEST(Defects, FacesThatNamePointsThatAreNotThereAreRefused) {
  TriMesh mesh = tetrahedron();
  mesh.triangles[1][1] = 4;
  EXPECT_THROW((void)defects_of(mesh), InputError);
}

}  // namespace
}  // namespace blendwright
