#include "kernel/geometry/curvature.hpp"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "kernel/geometry/rigid_motion.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::Rng;
using test::uniform;

constexpr double eps = 2.220446049250313e-16;

// Torus of radii R, r; a sphere for R = 0 and nearly a cylinder of radius r for large R. Normal Su x Sv
// points inwards.
SurfaceJet torus(double R, double r, double u, double v) {
  const double cu = std::cos(u), su = std::sin(u), cv = std::cos(v), sv = std::sin(v), rho = R + r * cu;
  return {{rho * cv, rho * sv, r * su},   {-r * su * cv, -r * su * sv, r * cu},
          {-rho * sv, rho * cv, 0},       {-r * cu * cv, -r * cu * sv, -r * su},
          {r * su * sv, -r * su * cv, 0}, {-rho * cv, -rho * sv, 0}};
}

Vec3 random_vector(Rng& rng) { return {uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1)}; }

TEST(Curvature, OfASphereIsTheInverseRadiusInEveryDirection) {
  for_all([](Rng& rng) {
    const double r = uniform(rng, 0.1, 10.0);
    const SurfaceJet jet = torus(0.0, r, uniform(rng, -1.2, 1.2), uniform(rng, 0, 6));
    const SurfaceCurvature k = curvature(jet);
    // cos u >= 0.36: the condition of the parametrisation is below 10.
    const double tolerance = 500 * eps / r;
    EXPECT_NEAR(k.k_min, 1 / r, tolerance);
    EXPECT_NEAR(k.k_max, 1 / r, tolerance);
    EXPECT_NEAR(k.mean, 1 / r, tolerance);
    EXPECT_NEAR(k.gaussian, 1 / (r * r), 2 * tolerance / r);
    EXPECT_NEAR(normal_curvature(jet, random_vector(rng), unit_normal(jet)), 1 / r, 10 * tolerance);
  });
}

TEST(Curvature, OfATorusHasTheKnownPrincipalValues) {
  for_all([](Rng& rng) {
    const double R = uniform(rng, 1.0, 3.0), r = uniform(rng, 0.1, 0.8), u = uniform(rng, -3, 3);
    const SurfaceJet jet = torus(R, r, u, uniform(rng, 0, 6));
    const double along = std::cos(u) / (R + r * std::cos(u));
    const SurfaceCurvature k = curvature(jet);
    EXPECT_NEAR(k.k_max, 1 / r, 100 * eps / r);
    EXPECT_NEAR(k.k_min, along, 100 * eps / r);
    EXPECT_NEAR(normal_curvature(jet, jet.Su, unit_normal(jet)), 1 / r, 100 * eps / r);
    EXPECT_NEAR(normal_curvature(jet, jet.Sv, unit_normal(jet)), along, 100 * eps / r);
    EXPECT_NEAR(normal_curvature(jet, jet.Sv, -unit_normal(jet)), -along, 100 * eps / r);
    // Euler: between the principal directions the curvature is the weighted mean; a normal part of the
    // direction is dropped.
    const Vec3 mixed = jet.Su.normalized() + jet.Sv.normalized() + 5.0 * unit_normal(jet);
    EXPECT_NEAR(normal_curvature(jet, mixed, unit_normal(jet)), 0.5 * (1 / r + along), 1000 * eps / r);
  });
}

TEST(Curvature, OfACylinderIsZeroAlongTheAxis) {
  const double r = 2.5;
  const SurfaceJet jet{{r, 0, 0}, {0, r, 0}, {0, 0, 1}, {-r, 0, 0}, Vec3::Zero(), Vec3::Zero()};
  const SurfaceCurvature k = curvature(jet);
  EXPECT_EQ(unit_normal(jet), Vec3(1, 0, 0));
  EXPECT_NEAR(k.k_min, -1 / r, eps);
  EXPECT_EQ(k.k_max, 0.0);
  EXPECT_EQ(k.gaussian, 0.0);
  EXPECT_EQ(normal_curvature(jet, Vec3::UnitZ(), Vec3::UnitX()), 0.0);
}

TEST(Curvature, DoesNotChangeUnderRigidMotionAndReparametrisation) {
  for_all([](Rng& rng) {
    const SurfaceJet a = torus(2.0, 0.7, uniform(rng, -3, 3), uniform(rng, 0, 6));
    const Eigen::Matrix3d Q =
        Eigen::AngleAxisd(uniform(rng, 0, 3), random_vector(rng).normalized()).toRotationMatrix();
    // u = x + c y^2 / 2 + s x y, v = 2 y - x at (x, y) = (0, 0): first order [1 0; -1 2], second order on u
    // alone.
    const double c = uniform(rng, -1, 1), s = uniform(rng, -1, 1);
    SurfaceJet b;
    b.S = a.S;
    b.Su = a.Su - a.Sv;
    b.Sv = 2 * a.Sv;
    b.Suu = a.Suu - 2 * a.Suv + a.Svv;
    b.Suv = 2 * a.Suv - 2 * a.Svv + s * a.Su;
    b.Svv = 4 * a.Svv + c * a.Su;
    for (Vec3* d : {&b.S, &b.Su, &b.Sv, &b.Suu, &b.Suv, &b.Svv}) *d = (Q * *d).eval();
    const SurfaceCurvature ka = curvature(a), kb = curvature(b);
    EXPECT_NEAR(ka.mean, kb.mean, 1000 * eps);
    EXPECT_NEAR(ka.gaussian, kb.gaussian, 1000 * eps);
    EXPECT_NEAR(ka.k_min, kb.k_min, 1000 * eps);
    EXPECT_NEAR(ka.k_max, kb.k_max, 1000 * eps);
  });
}

TEST(Curvature, IsNotANumberWhereTheSurfaceIsDegenerate) {
  SurfaceJet jet = torus(2.0, 0.5, 0.3, 0.4);
  EXPECT_TRUE(std::isfinite(curvature(jet).mean));
  jet.Sv = 2.0 * jet.Su;
  EXPECT_EQ(unit_normal(jet), Vec3::Zero());
  EXPECT_TRUE(std::isnan(curvature(jet).mean));
  EXPECT_TRUE(std::isnan(curvature(jet).k_max));
  EXPECT_TRUE(std::isnan(normal_curvature(jet, Vec3::UnitX(), Vec3::UnitZ())));
  jet.Sv.setZero();
  EXPECT_EQ(unit_normal(jet), Vec3::Zero());
}

TEST(PlaneAngle, MeasuresSmallTiltsAndIgnoresTheSideOfTheNormal) {
  for (double tilt : {1e-15, 1e-9, 1e-3, 0.7}) {
    const Vec3 n(0, 0, 1), m(std::sin(tilt), 0, std::cos(tilt));
    EXPECT_NEAR(plane_angle(n, m).value, tilt, 4 * eps * tilt);
    EXPECT_NEAR(plane_angle(n, -m).value, tilt, 4 * eps * tilt);
  }
  EXPECT_NEAR(plane_angle(Vec3::UnitX(), Vec3::UnitY()).value, std::numbers::pi / 2, eps);
}

}  // namespace
}  // namespace blendwright
