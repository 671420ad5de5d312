// Primaries are drawn without what their blends replace.
#include "app/view/window/trimmed_mesh.hpp"

#include <gtest/gtest.h>

namespace blendwright {
namespace {

/// [0, 1]^2 in z = 0 as n x n cells.
TriMesh square(std::uint32_t n) {
  TriMesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) mesh.points.emplace_back(1.0 * i / n, 1.0 * j / n, 0.0);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j;
      mesh.triangles.push_back({a, a + n + 1, a + n + 2});
      mesh.triangles.push_back({a, a + n + 2, a + 1});
    }
  return mesh;
}

double area(const TriMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles)
    sum += 0.5 * (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]).norm();
  return sum;
}

/// x = at, kept where x is larger (sign > 0) or smaller.
KeptSide line_at(double at, double sign) {
  KeptSide line;
  for (int i = 0; i <= 100; ++i) {
    line.points.emplace_back(at, 0.01 * i, 0.0);
    line.inward.emplace_back(sign, 0.0, 0.0);
  }
  return line;
}

TEST(TrimmedMesh, StraightCutsAreExact) {
  // The distance is linear in x: rounding only.
  EXPECT_NEAR(area(trimmed_mesh(square(7), {line_at(0.3, 1.0)})), 0.7, 1e-14);
  EXPECT_NEAR(area(trimmed_mesh(square(7), {line_at(0.3, -1.0)})), 0.3, 1e-14);
}

TEST(TrimmedMesh, SeveralLinesKeepWhatAllOfThemKeep) {
  const TriMesh mesh = trimmed_mesh(square(7), {line_at(0.3, 1.0), line_at(0.8, -1.0)});
  // Where the nearer line changes, the least distance has a kink within a cell: inside the kept part.
  EXPECT_NEAR(area(mesh), 0.5, 1e-14);
}

TEST(TrimmedMesh, WithoutLinesEverythingStays) {
  EXPECT_NEAR(area(trimmed_mesh(square(5), {})), 1.0, 1e-14);
  EXPECT_EQ(trimmed_mesh(square(5), {line_at(-2.0, -1.0)}).triangles.size(), 0u);
}

}  // namespace
}  // namespace blendwright
