#include <gtest/gtest.h>

#include <limits>

#include "kernel/base/parallel_for.hpp"
#include "tests/verify/shapes.hpp"
#include "verify/continuity/seam.hpp"

namespace blendwright {
namespace {

using namespace test;

constexpr double eps = std::numeric_limits<double>::epsilon();
// Positions, normals and curvatures of shapes of size 1 come from some ten rounded operations each.
constexpr double rounding = 50.0 * eps;

// A joint with every defect at once, each varying along v.
Surface defective() {
  return surface(turn, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    const T r = 1.0 + 1e-3 * cos(v) + (0.05 + 0.02 * sin(2.0 * v)) * u + (0.3 + 0.1 * cos(3.0 * v)) * u * u;
    return std::array<T, 3>{r * cos(v + 0.1 * u), r * sin(v + 0.1 * u), 1.0 + u + 1e-3 * sin(v)};
  });
}

void expect_same(const SeamReport& a, const SeamReport& b, double tolerance) {
  EXPECT_NEAR(a.gap.worst, b.gap.worst, tolerance);
  EXPECT_NEAR(a.surface_gap.worst, b.surface_gap.worst, tolerance);
  EXPECT_NEAR(a.angle.worst, b.angle.worst, tolerance);
  EXPECT_NEAR(a.curvature.worst, b.curvature.worst, tolerance);
  EXPECT_NEAR(a.transverse.worst, b.transverse.worst, tolerance);
  EXPECT_NEAR(a.fold.worst, b.fold.worst, tolerance);
  EXPECT_NEAR(a.curvature.rms, b.curvature.rms, tolerance);
}

TEST(Seam, RigidMotionChangesNothing) {
  const Seam seam = on_cylinder(defective());
  const SeamReport still = check_seam(seam, {256, true});
  for_all(
      [&](Rng& rng) {
        const RigidMotion motion = random_motion(rng);
        Seam moved = seam;
        moved.blend = placed(seam.blend, motion);
        moved.primary = placed(*seam.primary, motion);
        // Coordinates up to 10: positions are rounded at 1e-15, and golden section ends on a flat top.
        expect_same(check_seam(moved, {256, true}), still, 1e-12);
      },
      20);
}

TEST(Seam, ReparametrisedPrimaryChangesNothing) {
  const SeamReport plain = check_seam(on_cylinder(defective()), {256, true});
  const Surface other =
      surface({{-1.0, 1.0}, {0.0, 2.0 * pi}, false, true}, [](const auto& u, const auto& v) {
        using T = std::remove_cvref_t<decltype(u)>;
        const T angle = v + 0.3 * sin(v);
        return std::array<T, 3>{cos(angle), sin(angle), u * (2.0 + u) / 3.0};
      });
  // u = 1 is z = 1; the line runs at the angle v' with v' + 0.3 sin v' = v, so instead the blend is run by
  // the map.
  const Surface blend = surface(turn, [](const auto& u, const auto& w) {
    using T = std::remove_cvref_t<decltype(u)>;
    const T v = w + 0.3 * sin(w);
    const T r = 1.0 + 1e-3 * cos(v) + (0.05 + 0.02 * sin(2.0 * v)) * u + (0.3 + 0.1 * cos(3.0 * v)) * u * u;
    return std::array<T, 3>{r * cos(v + 0.1 * u), r * sin(v + 0.1 * u), 1.0 + u + 1e-3 * sin(v)};
  });
  const Seam seam{"test/from", blend, 0, other, isoline_u(1.0, turn_line), true};
  SeamReport r = check_seam(seam, {256, true});
  r.curvature.rms = plain.curvature.rms;  // a mean over v depends on v
  // The worst values are at different samples; golden section ends within 1e-3 of a step of 0.025 from the
  // top, and values there differ by half the square times a second derivative of at most 1.
  expect_same(r, plain, 1e-9);
}

TEST(Seam, SwappedSidesChangeNothing) {
  const SeamReport plain = check_seam(on_cylinder(defective()), {256, true});
  const Surface forward = defective();
  const Surface backward = surface(turn, [](const auto& t, const auto& v) {
    using T = std::remove_cvref_t<decltype(t)>;
    const T u = 1.0 - t;
    const T r = 1.0 + 1e-3 * cos(v) + (0.05 + 0.02 * sin(2.0 * v)) * u + (0.3 + 0.1 * cos(3.0 * v)) * u * u;
    return std::array<T, 3>{r * cos(v + 0.1 * u), r * sin(v + 0.1 * u), 1.0 + u + 1e-3 * sin(v)};
  });
  Seam seam = on_cylinder(backward);
  seam.side = 1;
  expect_same(check_seam(seam, {256, true}), plain, rounding);
}

TEST(Seam, WorstPlaceIsThePlantedBump) {
  for_all(
      [](Rng& rng) {
        const double v0 = uniform(rng, 0.3, 6.0), height = log_uniform(rng, 1e-8, 1e-2);
        const Surface bumped = surface(turn, [v0, height](const auto& u, const auto& v) {
          using T = std::remove_cvref_t<decltype(u)>;
          const T x = (v - v0) * 20.0;
          const T r = 1.0 + height * exp(-1.0 * (x * x));
          return std::array<T, 3>{r * cos(v), r * sin(v), 1.0 + u};
        });
        const SeamReport r = check_seam(on_cylinder(bumped), {256, true});
        // Golden section stops at 1e-3 of two steps of 2 pi / 254 (5e-5), or where rounding flattens the top:
        // height (20 dv)^2 < 4 eps; the value is below the top by 400 dv^2 height.
        const double place = 5e-5 + std::sqrt(8.0 * eps / height) / 20.0;
        EXPECT_NEAR(r.gap.v, v0, place);
        EXPECT_NEAR(r.gap.worst, height, 400.0 * place * place * height + rounding);
        EXPECT_NEAR((r.gap.point - Vec3(std::cos(v0), std::sin(v0), 1.0)).norm(), 0.0, place + height);
      },
      50);
}

TEST(Seam, NothingDependsOnTheNumberOfThreads) {
  Seam seam = on_cylinder(defective());
  seam.pcurve.reset();
  const SeamReport many = check_seam(seam);
  const ThreadLimit one(1);
  const SeamReport single = check_seam(seam);
  EXPECT_EQ(many.gap_at, single.gap_at);
  EXPECT_EQ(many.curvature_at, single.curvature_at);
  EXPECT_EQ(many.angle.worst, single.angle.worst);
  EXPECT_EQ(many.curvature.v, single.curvature.v);
  EXPECT_EQ(many.fold.rms, single.fold.rms);
}

}  // namespace
}  // namespace blendwright
