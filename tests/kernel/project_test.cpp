#include "kernel/geometry/project.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "kernel/geometry/rigid_motion.hpp"
#include "kernel/primitives/quadrics.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::Rng;
using test::uniform;

constexpr double pi = std::numbers::pi;
constexpr Interval turn{0.0, 2.0 * pi};
// Sizes are of order 1; Newton ends with an error of the order of rounding, times the few operations of a jet
// and the condition 1 / (1 - distance / radius) <= 10 of the cases.
constexpr double exact = 1e-13;

Surface sphere(double r) { return Sphere({{{{-pi / 2, pi / 2}, turn, false, true}}, r}); }
Surface torus(double R, double r) { return Torus({{{turn, turn, true, true}}, R, r}); }
Surface cylinder(double r, Interval length) { return Cylinder({{{length, turn, false, true}}, r}); }
Surface plane(Interval x, Interval y) { return Plane(PlaneShape{{{x, y, false, false}}}); }

Vec3 random_direction(Rng& rng) {
  for (;;) {
    const Vec3 d(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1));
    if (d.norm() > 0.1 && d.norm() < 1.0) return d.normalized();
  }
}

TEST(ClosestPoint, OnASphereLiesOnTheRayFromTheCentre) {
  for_all(
      [](Rng& rng) {
        const Vec3 direction = random_direction(rng);
        const Vec3 q = direction * uniform(rng, 0.2, 5.0);
        const Foot foot = closest_point(sphere(2.0), q);
        ASSERT_LE((foot.point - 2.0 * direction).norm(), 10 * exact);
        ASSERT_NEAR(foot.distance, std::abs(q.norm() - 2.0), exact);
        ASSERT_TRUE(foot.interior);
        ASSERT_LE((sphere(2.0).point(foot.at) - foot.point).norm(), exact);
      },
      400);
}

TEST(ClosestPoint, FindsTheNeighbourhoodOfThePoleFromAllSides) {
  for_all(
      [](Rng& rng) {
        const double tilt = std::pow(10.0, uniform(rng, -9.0, -0.5)), turned = uniform(rng, 0.0, 2.0 * pi);
        const double side = rng.next() % 2 == 0 ? 1.0 : -1.0;
        const Vec3 direction(std::sin(tilt) * std::cos(turned), std::sin(tilt) * std::sin(turned),
                             side * std::cos(tilt));
        const Foot foot = closest_point(sphere(1.0), 1.5 * direction);
        // f = |S - q|^2 / 2 grows by 0.75 t^2 at a distance t; below 8 eps (size 10) |S - q| = 1e-14 that is
        // rounding.
        ASSERT_LE((foot.point - direction).norm(), 1.2e-7);
        ASSERT_NEAR(foot.distance, 0.5, exact);
      },
      400);
}

TEST(ClosestPoint, LeavesAPoleThatWasGuessed) {
  const Vec3 direction = Vec3(-0.3, 0.4, 2.0).normalized();
  const Foot foot = closest_point(sphere(1.0), 2.0 * direction, {pi / 2, 5.0});
  EXPECT_LE((foot.point - direction).norm(), 10 * exact);
}

TEST(ClosestPoint, OnATorusLiesOnTheTubeBesideTheCentreCircle) {
  const double R = 3.0, r = 1.0;
  for_all(
      [&](Rng& rng) {
        const double v = uniform(rng, 0.0, 2.0 * pi), tube = uniform(rng, 0.0, 2.0 * pi),
                     rho = uniform(rng, 0.1, 2.5);
        const Vec3 out(std::cos(v), std::sin(v), 0.0);
        const Vec3 direction = std::cos(tube) * out + std::sin(tube) * Vec3::UnitZ();
        const Vec3 q = R * out + rho * direction;
        const Foot foot = closest_point(torus(R, r), q);
        ASSERT_LE((foot.point - (R * out + r * direction)).norm(), 20 * exact);
        ASSERT_NEAR(foot.distance, std::abs(rho - r), exact);
      },
      400);
}

TEST(ClosestPoint, OnAPlaneIsTheProjectionOrTheBorder) {
  for_all([](Rng& rng) {
    const Vec3 q(uniform(rng, -3, 3), uniform(rng, -3, 3), uniform(rng, -3, 3));
    const Foot foot = closest_point(plane({-1, 1}, {-2, 2}), q);
    const Vec3 expected(std::clamp(q[0], -1.0, 1.0), std::clamp(q[1], -2.0, 2.0), 0.0);
    ASSERT_LE((foot.point - expected).norm(), exact);
    ASSERT_EQ(foot.interior, std::abs(q[0]) <= 1.0 && std::abs(q[1]) <= 2.0);
  });
}

TEST(ClosestPoint, FromAGuessCrossesTheSeam) {
  for_all([](Rng& rng) {
    const double v = uniform(rng, -0.5, 0.5), guess = uniform(rng, -0.7, 0.7);
    const Vec3 q(2.0 * std::cos(v), 2.0 * std::sin(v), 0.3);
    const Foot foot = closest_point(cylinder(1.0, {-1, 1}), q, {-0.2, guess + (guess < 0 ? 2.0 * pi : 0.0)});
    ASSERT_LE((foot.point - Vec3(std::cos(v), std::sin(v), 0.3)).norm(), exact);
    ASSERT_GE(foot.at.v, 0.0);
    ASSERT_LE(foot.at.v, 2.0 * pi);
  });
}

TEST(ClosestPoint, OfAPlacedSurfaceMovesAlong) {
  const RigidMotion motion = RigidMotion::from_axis(Vec3(1, 2, 3), Vec3(1, 1, 2));
  for_all(
      [&](Rng& rng) {
        const Vec3 q(uniform(rng, -4, 4), uniform(rng, -4, 4), uniform(rng, -4, 4));
        const Foot there = closest_point(placed(torus(3.0, 1.0), motion), motion(q));
        ASSERT_NEAR(there.distance, closest_point(torus(3.0, 1.0), q).distance, 10 * exact);
      },
      100);
}

/// Counts evaluations of the surface it wraps.
struct Counted {
  Surface surface;
  std::shared_ptr<int> jets = std::make_shared<int>(0);
  [[nodiscard]] SurfaceJet jet(UV p) const {
    ++*jets;
    return surface.jet(p);
  }
  [[nodiscard]] SurfacePartials partials(UV p) const { return surface.partials(p); }
  [[nodiscard]] SurfaceDomain domain() const { return surface.domain(); }
};

TEST(ClosestPoint, TakesFewJetsFromAGoodGuess) {
  for_all([](Rng& rng) {
    const UV at{uniform(rng, 0, 2 * pi), uniform(rng, 0, 2 * pi)};
    const Counted counted{torus(3.0, 1.0)};
    const SurfaceJet j = counted.surface.jet(at);
    const Vec3 q = j.S + uniform(rng, -0.2, 0.2) * j.Su.cross(j.Sv).normalized();
    const Foot foot = closest_point(Surface(counted), q, {at.u + 0.02, at.v - 0.02});
    ASSERT_LE((foot.point - j.S).norm(), exact * 10);
    // Errors 2e-2, 4e-4, 2e-7, 4e-14: the guess, three steps that square the error, one to see the end.
    ASSERT_LE(*counted.jets, 5);
  });
}

TEST(Shoot, HitsTheSphereAtTheNearerOfItsTwoPoints) {
  for_all([](Rng& rng) {
    const Vec3 d = random_direction(rng);
    const Vec3 side = d.unitOrthogonal() * uniform(rng, 0.0, 0.9);
    const Vec3 q = side - 3.0 * d;
    const auto hit = shoot(sphere(1.0), q, 2.0 * d);
    ASSERT_TRUE(hit);
    const Vec3 expected = side - d * std::sqrt(1.0 - side.squaredNorm());
    ASSERT_LE((hit->point - expected).norm(), 1e-12);  // slope across the ray up to 1 / sqrt(1 - 0.81) = 2.3
    ASSERT_NEAR(hit->distance, (expected - q).norm(), 1e-12);
  });
}

TEST(Shoot, MissesWhatTheLineDoesNotMeet) {
  EXPECT_FALSE(shoot(sphere(1.0), Vec3(0, 1.01, 0), Vec3::UnitX()));
  EXPECT_FALSE(shoot(plane({-1, 1}, {-1, 1}), Vec3(1.01, 0, 3), Vec3::UnitZ()));  // beside the border
  EXPECT_FALSE(shoot(plane({-1, 1}, {-1, 1}), Vec3(0, 0, 1), Vec3::UnitX()));     // parallel
  EXPECT_TRUE(shoot(plane({-1, 1}, {-1, 1}), Vec3(1.0, 0.5, 3), Vec3::UnitZ()));  // on the border
  EXPECT_TRUE(shoot(sphere(1.0), Vec3(0, 0.99, 0), Vec3::UnitX()));
}

TEST(Shoot, HitsThePoleOfASphereFromEverySeed) {
  const Surface ball = sphere(2.0);
  const SurfaceDomain box = ball.domain();
  for (const double beside : {0.0, 1e-18, 1e-12, 1e-7, 1e-3}) {
    const Vec3 q(0.0, beside, 5.0);
    const Vec3 expected(0.0, beside, std::sqrt(4.0 - beside * beside));
    const auto hit = shoot(ball, q, -Vec3::UnitZ());
    ASSERT_TRUE(hit) << beside;
    EXPECT_LE((hit->point - expected).norm(), 1e-11) << beside;  // 1e-12 of the size, which is 2 pi 2 at most
    for (int i = 0; i < 100; ++i)
      EXPECT_TRUE(
          shoot(ball, q, -Vec3::UnitZ(), {box.u.at((i / 10 + 0.5) / 10), box.v.at((i % 10 + 0.5) / 10)}))
          << beside << " seed " << i;
  }
}

TEST(Shoot, FromAGuessFindsTheIntersectionBesideIt) {
  const auto far = shoot(sphere(1.0), Vec3(-3, 0.2, 0.1), Vec3::UnitX(), {0.0, 0.2});
  ASSERT_TRUE(far);
  EXPECT_GT(far->point[0], 0.0);
}

/// (cos v, sin v, 0)
struct Circle {
  bool closed = true;
  template <class T>
  std::array<T, 3> operator()(const T& v) const {
    const auto [s, c] = sin_cos(v);
    return {c, s, T(0.0)};
  }
  [[nodiscard]] CurveDomain domain() const { return {closed ? turn : Interval{0.0, 1.0}, closed}; }
};

TEST(ClosestPoint, OnACircleLiesOnTheRayFromTheCentre) {
  for_all([](Rng& rng) {
    const double v = uniform(rng, 0.0, 2.0 * pi), rho = uniform(rng, 0.2, 3.0);
    const Vec3 q(rho * std::cos(v), rho * std::sin(v), uniform(rng, -1.0, 1.0));
    const CurveFoot foot =
        closest_point(Curve3(FormulaCurve<Circle, 3>(Circle{})), q, v + uniform(rng, -1.2, 1.2));
    ASSERT_LE((foot.point - Vec3(std::cos(v), std::sin(v), 0.0)).norm(), 10 * exact);
    ASSERT_NEAR(foot.distance, (foot.point - q).norm(), exact);
  });
}

TEST(ClosestPoint, OnAnOpenArcStopsAtItsEnd) {
  const CurveFoot foot =
      closest_point(Curve3(FormulaCurve<Circle, 3>(Circle{false})), Vec3(0.0, 3.0, 0.0), 0.2);
  EXPECT_DOUBLE_EQ(foot.v, 1.0);
}

}  // namespace
}  // namespace blendwright
