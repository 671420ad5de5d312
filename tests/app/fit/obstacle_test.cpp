// Obstacles know how far they are, and which way leads away from them.
#include "app/pipeline/obstacle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernel/exchange/mesh_files.hpp"
#include "tests/app/program.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

TriMesh cube(bool whole) {  // [0, 1]^3, outward
  TriMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.points.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  if (!whole) mesh.triangles.resize(10);  // the side x = 1 is open
  return mesh;
}

double distance_to_cube(const Vec3& p) {
  const Vec3 q = (p - Vec3::Constant(0.5)).cwiseAbs() - Vec3::Constant(0.5);
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

TEST(Obstacle, OfAClosedMeshIsItsSignedDistance) {
  const Folder folder;
  write_obj(folder / "cube.obj", std::vector<TriMesh>{cube(true)});
  const Obstacle obstacle = read_obstacle("cube.obj", folder.path(), LengthUnit::millimetre);
  for_all([&](Rng& rng) {
    const Vec3 p(uniform(rng, -1.0, 2.0), uniform(rng, -1.0, 2.0), uniform(rng, -1.0, 2.0));
    const ObstacleSample s = obstacle(p);
    EXPECT_NEAR(s.distance, distance_to_cube(p), 1e-14);  // a few roundings of coordinates up to 2
    // Up the gradient by h the distance grows by h, outside of it at most.
    if (std::abs(s.distance) > 0.02) {
      EXPECT_NEAR(distance_to_cube(p + 1e-3 * s.gradient), s.distance + 1e-3,
                  s.distance > 0.0 ? 1e-12 : 2e-3);
    }
  });
  EXPECT_LT(obstacle(Vec3(0.5, 0.5, 0.9)).distance, 0.0);
}

TEST(Obstacle, OfAnOpenMeshHasNoInside) {
  const Folder folder;
  write_obj(folder / "open.obj", std::vector<TriMesh>{cube(false)});
  const Obstacle obstacle = read_obstacle("open.obj", folder.path(), LengthUnit::millimetre);
  EXPECT_NEAR(obstacle(Vec3(0.5, 0.5, 0.9)).distance, 0.1, 1e-15);
  EXPECT_NEAR(obstacle(Vec3(0.5, 0.5, 1.1)).distance, 0.1, 1e-15);
}

TEST(Obstacle, OfASceneIsItsDistanceToFirstOrder) {
  const Folder folder;
  write(folder / "ball.json", R"({ "nodes": {
    "ball": { "kind": "superquadric", "a": 2, "b": 2, "c": 2, "n1": 2, "n2": 2 } }, "solid": "ball" })");
  const Obstacle obstacle = read_obstacle("ball.json#ball", folder.path(), LengthUnit::millimetre);
  for_all([&](Rng& rng) {
    const Vec3 n =
        Vec3(uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0), uniform(rng, 0.1, 1.0)).normalized();
    const double d = uniform(rng, -0.02, 0.02);
    const ObstacleSample s = obstacle((2.0 + d) * n);
    // First order: the rest is at most (f'' / f') d^2 with f' and f'' of powers of |p| / 2 up to 4.
    EXPECT_NEAR(s.distance, d, 4.0 * d * d + 1e-12);
    EXPECT_NEAR((s.gradient - n).norm(), 0.0, 1e-9);
  });
  EXPECT_THROW(static_cast<void>(read_obstacle("ball.json", folder.path(), LengthUnit::inch)), InputError);
}

TEST(Scan, IsReadFromPointsAndMeshes) {
  const Folder folder;
  write(folder / "scan.csv", "x, y, z\n1, 2, 3\n4, 5, 6\n");
  EXPECT_EQ(read_scan("scan.csv", folder.path()), (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
  for (const char* name : {"scan.obj", "scan.stl", "scan.ply", "scan.vtp"}) {
    const TriMesh mesh = cube(true);
    const std::string end = fs::path(name).extension();
    if (end == ".obj") write_obj(folder / name, std::vector<TriMesh>{mesh});
    if (end == ".stl") write_stl(folder / name, std::vector<TriMesh>{mesh});
    if (end == ".ply") write_ply(folder / name, mesh);
    if (end == ".vtp") write_vtp(folder / name, mesh);
    EXPECT_EQ(read_scan(name, folder.path()).size(), 8u) << name;
  }
}

}  // namespace
}  // namespace blendwright::test
