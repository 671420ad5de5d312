// What the criteria of the example scenes are measured with: each tool on shapes whose figures are known, and
// on shapes that it must tell apart.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/implicit/scenes/rays.hpp"
#include "tests/implicit/scenes/voxels.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

/// A function of points from one of a single point.
template <class F>
PointFunction each(F f) {
  return [f](std::span<const Vec3> points) {
    std::vector<double> v;
    for (const Vec3& p : points) v.push_back(f(p));
    return v;
  };
}

TEST(PrintedDigits, AcceptHalfAUnitOfTheLastOneAndNoMore) {
  EXPECT_TRUE(prints_as(5.73965, "5.7397"));
  EXPECT_TRUE(prints_as(5.7397499, "5.7397"));
  EXPECT_FALSE(prints_as(5.73976, "5.7397"));
  EXPECT_FALSE(prints_as(5.7396, "5.7397"));
  EXPECT_TRUE(prints_as(20.4, "20"));
}

TEST(RadiusAlongARay, IsThatOfTheSphere) {
  const PointFunction ball = each([](const Vec3& p) { return 3.0 - p.norm(); });
  EXPECT_NEAR(radius(ball, Vec3::Zero(), {1, 2, 3}, 10.0), 3.0, 1e-15 * 3.0);
  EXPECT_NEAR(radius(ball, {1, 0, 0}, {1, 0, 0}, 10.0), 2.0, 1e-15 * 3.0);
}

TEST(RadiusAlongARay, RefusesRaysThatDoNotCross) {
  const PointFunction ball = each([](const Vec3& p) { return 3.0 - p.norm(); });
  EXPECT_THROW((void)radius(ball, Vec3::Zero(), {1, 0, 0}, 2.0), std::runtime_error);
  EXPECT_THROW((void)radius(ball, {4, 0, 0}, {1, 0, 0}, 2.0), std::runtime_error);
}

TEST(IsolatedMaxima, AreTheCornersOfACubeAndTheBallsOfAClover) {
  // Corners: kinks on top; clover: smooth tops at +-x, +-y and +-z.
  const PointFunction cube = each([](const Vec3& d) { return 1.0 / d.cwiseAbs().maxCoeff(); });
  const std::vector<Peak> corners = isolated_maxima(cube);
  ASSERT_EQ(corners.size(), 8u);
  for (const Peak& p : corners) EXPECT_NEAR(p.height, std::numbers::sqrt3, 1e-7);
  const PointFunction clover = each([](const Vec3& d) { return d.array().pow(4).sum(); });
  EXPECT_EQ(isolated_maxima(clover).size(), 6u);
}

TEST(IsolatedMaxima, DoNotCountAnEquator) {
  const PointFunction disc = each([](const Vec3& d) { return 1.0 - d.z() * d.z(); });
  EXPECT_EQ(isolated_maxima(disc).size(), 0u);
  const Peak top = highest(disc), pole = lowest(disc);
  EXPECT_NEAR(top.height, 1.0, 1e-14);
  EXPECT_NEAR(pole.height, 0.0, 1e-14);
  EXPECT_NEAR(std::abs(pole.direction.z()), 1.0, 1e-12);
}

TEST(IsolatedMaxima, AreFoundWhereverTheyLie) {
  for_all(
      [](Rng& rng) {
        const Vec3 axis = Vec3(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1)).normalized();
        const std::vector<Peak> found =
            isolated_maxima(each([&](const Vec3& d) { return std::exp(20.0 * (d.dot(axis) - 1.0)); }));
        ASSERT_EQ(found.size(), 1u);
        // The height falls by 10 angle^2: what is lost in rounding (1e-16) is an angle of 3e-9, the last step
        // 1e-8.
        EXPECT_LE((found[0].direction - axis).norm(), 5e-8);
      },
      20);
}

TEST(MaximaOfASection, AreCountedAcrossTheSeamAndWithoutNoise) {
  std::vector<double> wave(3600);
  for (std::size_t k = 0; k < wave.size(); ++k) {
    const double t = 2.0 * std::numbers::pi * static_cast<double>(k) / 3600.0;
    wave[k] = 5.0 + std::cos(6.0 * t) + (k % 2 == 0 ? 1e-3 : 0.0);  // a maximum at the seam
  }
  EXPECT_EQ(count_maxima(wave, 1e-2), 6);
  EXPECT_EQ(count_maxima(wave, 3.0), 0);
  EXPECT_GT(count_maxima(wave, 1e-4), 6);
}

TEST(AreaOfASection, IsThatOfTheEllipse) {
  std::vector<double> r;
  for (int k = 0; k < 400; ++k) {
    const double t = 2.0 * std::numbers::pi * k / 400.0;
    r.push_back(1.0 / std::hypot(std::cos(t) / 3.0, std::sin(t) / 2.0));
  }
  EXPECT_NEAR(area(r), 6.0 * std::numbers::pi, 1e-12);
}

/// Voxels of a point function on [-1, 1]^3.
template <class F>
Voxels voxels(F inside_of, std::size_t n = 40) {
  Voxels v{n, {}};
  const auto at = [&](std::size_t i) {
    return 2.0 * static_cast<double>(i) / static_cast<double>(n - 1) - 1.0;
  };
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) v.inside.push_back(inside_of(Vec3(at(i), at(j), at(k))) ? 1 : 0);
  return v;
}

TEST(VoxelTopology, TellsBallShellRingAndPair) {
  const Voxels ball = voxels([](const Vec3& p) { return p.norm() < 0.9; });
  EXPECT_EQ(euler_characteristic(ball), 1);
  EXPECT_EQ(components(ball), 1u);
  const Voxels shell = voxels([](const Vec3& p) { return p.norm() < 0.8 && p.norm() > 0.4; });
  EXPECT_EQ(euler_characteristic(shell), 2);
  const Voxels ring =
      voxels([](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 0.6, p.z()) < 0.2; });
  EXPECT_EQ(euler_characteristic(ring), 0);
  const Voxels pair = voxels([](const Vec3& p) { return (p.cwiseAbs() - Vec3(0.5, 0, 0)).norm() < 0.3; });
  EXPECT_EQ(euler_characteristic(pair), 2);
  EXPECT_EQ(components(pair), 2u);
  EXPECT_EQ(components(difference(ball, pair)), 1u);
}

}  // namespace
}  // namespace blendwright::test
