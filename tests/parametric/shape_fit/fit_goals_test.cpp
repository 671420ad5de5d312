// What a fit must reach, on blends that are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "kernel/geometry/curvature.hpp"
#include "tests/parametric/shape_fit/fit_scenes.hpp"

namespace blendwright {
namespace {

using namespace test;
using ::testing::HasSubstr;

double seconds_of(const auto& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Largest |radius - R| / R of the u-lines in the middle, by the kernel's curvature.
double radius_error(const Blend& blend, double R) {
  double worst = 0.0;
  for (int i = 0; i < 400; ++i) {
    const SurfaceJet j = blend.surface.jet({0.5, blend.surface.domain().v.at(i / 400.0)});
    worst = std::max(worst, std::abs(1.0 / std::abs(normal_curvature(j, j.Su, unit_normal(j))) - R) / R);
  }
  return worst;
}

TEST(ShapeFit, GivesTheMiddleOfABlendOfPerpendicularCylindersTheRadiusOfABall) {
  for (const double R : {0.6, 0.8}) {
    const FitScene scene = perpendicular_cylinders(Continuity::G2);
    ShapeFitOptions options;
    options.threads = 2;
    RollingBall ball;
    ball.radius = {{0.0, R}};
    ball.across = {0.5, 0.5};
    options.objectives = {ball};
    options.unknowns.magnitudes = {8, 8};
    ShapeFitResult result;
    const double seconds = seconds_of([&] { result = fit(scene, options); });
    const double before = radius_error(made(scene, scene.spec), R),
                 after = radius_error(made(scene, result.spec), R);
    std::printf("rolling ball %.1f: deviation %.2f %% before, %.3f %% after, %.2f s, %zu steps\n", R,
                100 * before, 100 * after, seconds, result.costs.size() - 1);
    EXPECT_GT(before, 0.01);
    EXPECT_LE(after, 0.01);
    EXPECT_TRUE(result.objectives[0].fulfilled);
  }
}

}  // namespace
}  // namespace blendwright
