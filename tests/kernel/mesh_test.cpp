#include "kernel/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <numbers>

#include "kernel/base/error.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/primitives/primary.hpp"
#include "kernel/primitives/quadrics.hpp"

namespace blendwright {
namespace {

constexpr double pi = std::numbers::pi;

Surface primary(const char* kind, std::map<std::string, double> numbers, std::optional<Interval> u = {},
                std::optional<Interval> v = {}) {
  PrimarySpec spec;
  spec.kind = kind;
  spec.numbers = std::move(numbers);
  spec.u = u;
  spec.v = v;
  return make_primary(spec);
}

/// How many triangles use each edge in its direction minus how many against it: 0 for an inner edge of an
/// oriented mesh.
std::size_t border_edges(const TriMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      uses[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  std::size_t border = 0;
  for (const auto& [edge, n] : uses) border += n != 0 ? 1u : 0u;
  return border;
}

double area(const TriMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return 0.5 * (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]).norm();
}
double area(const TriMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) sum += area(mesh, t);
  return sum;
}

void expect_sound(const TriMesh& mesh) {
  ASSERT_FALSE(mesh.triangles.empty());
  ASSERT_EQ(mesh.normals.size(), mesh.points.size());
  ASSERT_EQ(mesh.columns.size(), 2u);
  EXPECT_EQ(mesh.columns[0].name, "u");
  EXPECT_EQ(mesh.columns[1].name, "v");
  for (const Column& c : mesh.columns) EXPECT_EQ(c.values.size(), mesh.points.size());
  const double mean = area(mesh) / static_cast<double>(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    ASSERT_GT(area(mesh, t), 1e-6 * mean);
    const Vec3 flat = (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
    for (const std::uint32_t k : t)
      ASSERT_GT(mesh.normals[k].dot(flat), 0.0);  // same side as the surface's normal
  }
  for (const Vec3& n : mesh.normals) ASSERT_NEAR(n.norm(), 1.0, 1e-12);
}

TEST(Tessellate, ClosedSurfacesHaveNoBorder) {
  const std::vector<Surface> closed{primary("sphere", {{"radius", 2}}),
                                    primary("ellipsoid", {{"a", 1}, {"b", 2}, {"c", 3}}),
                                    primary("torus", {{"major_radius", 3}, {"minor_radius", 1}})};
  for (const Surface& surface : closed)
    for (const int n : {3, 4, 17}) {
      const TriMesh mesh = tessellate(surface, n, n + 1);
      expect_sound(mesh);
      EXPECT_EQ(border_edges(mesh), 0u);
    }
}

TEST(Tessellate, OpenSurfacesHaveTheBorderOfTheirDomain) {
  // Negative control of the check above, and the count of points with seam and pole shared.
  EXPECT_EQ(border_edges(tessellate(primary("cylinder", {{"radius", 1}}, Interval{0, 1}), 5, 8)), 2u * 8u);
  EXPECT_EQ(border_edges(tessellate(primary("plane", {}, Interval{0, 1}, Interval{0, 1}), 5, 8)), 2u * 13u);
  const TriMesh cone =
      tessellate(primary("cone", {{"radius", 0}, {"half_angle_deg", 30}}, Interval{0, 1}), 5, 8);
  expect_sound(cone);
  EXPECT_EQ(border_edges(cone), 8u);
  EXPECT_EQ(cone.points.size(), 1u + 5u * 8u);
  EXPECT_EQ(cone.triangles.size(), 8u + 2u * 4u * 8u);
  EXPECT_LE((cone.normals[0] - Vec3::UnitZ()).norm(), 1e-12);  // the apex takes the mean of its triangles
}

TEST(Tessellate, AreasConvergeWithTheSquareOfTheStep) {
  struct Case {
    Surface surface;
    double area;
  };
  const std::vector<Case> cases{
      {primary("sphere", {{"radius", 2}}), 16 * pi},
      {primary("torus", {{"major_radius", 3}, {"minor_radius", 1}}), 12 * pi * pi},
      {primary("cone", {{"radius", 0}, {"half_angle_deg", 30}}, Interval{0, 2}), 2 * pi}};
  for (const Case& c : cases) {
    const double coarse = std::abs(area(tessellate(c.surface, 32, 64)) / c.area - 1.0);
    const double fine = std::abs(area(tessellate(c.surface, 64, 128)) / c.area - 1.0);
    EXPECT_LT(coarse, 0.01);
    EXPECT_NEAR(coarse / fine, 4.0, 0.1);  // second order; the next term is h^2 = 1e-2 of it
  }
}

TEST(Tessellate, IsTheSameForAnyNumberOfThreads) {
  const Surface surface = primary("torus", {{"major_radius", 3}, {"minor_radius", 1}});
  const TriMesh parallel = tessellate(surface, 40, 50);
  const ThreadLimit one(1);
  const TriMesh serial = tessellate(surface, 40, 50);
  EXPECT_EQ(parallel.points, serial.points);
  EXPECT_EQ(parallel.normals, serial.normals);
  EXPECT_EQ(parallel.triangles, serial.triangles);
}

TEST(Tessellate, RefusesGridsThatCannotCloseOrDoNotFit) {
  const Surface cylinder = primary("cylinder", {{"radius", 1}}, Interval{0, 1});
  EXPECT_THROW(static_cast<void>(tessellate(cylinder, 1, 2)), InputError);
  EXPECT_THROW(static_cast<void>(tessellate(cylinder, 0, 8)), InputError);
  EXPECT_THROW(static_cast<void>(tessellate(cylinder, 1, 100000)), InputError);
  EXPECT_NO_THROW(static_cast<void>(tessellate(cylinder, 1, 3)));
}

}  // namespace
}  // namespace blendwright
