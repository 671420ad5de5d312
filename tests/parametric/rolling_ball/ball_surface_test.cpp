// The blend surface of a ball and its edges.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/geometry/curvature.hpp"
#include "parametric/blend.hpp"
#include "tests/parametric/rolling_ball/ball_scenes.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using namespace test;

BallPair cylinders(double r = 0.25) {
  return fillet(BallPrimary(cylinder_field(1.1, 0)), BallPrimary(cylinder_field(0.6, 2)), r);
}
Spine loop(const BallPair& pair) { return spine_near(pair, {0.85, 0, 1.35}, in_box(cube(2.5))); }
/// A cylinder about x and one about z, as surfaces.
BallPair surfaces(double r = 0.25) {
  const RigidMotion about_x = RigidMotion::from_axis({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  return fillet(outside_at(cylinder(1.1, -3.0, 3.0, about_x), {0, 0, 2}),
                outside_at(cylinder(0.6, -3.0, 3.0), {2, 0, 0}), r);
}

TEST(BallSurface, IsTangentToBothPrimaries) {
  // Independent of the feet: gradients of the fields at the surface's edges.
  const BallPair pair = cylinders();
  const Spine spine = loop(pair);
  for_all([&](Rng& rng) {
    const double s = uniform(rng, 0.0, spine.length());
    for (std::size_t side = 0; side < 2; ++side) {
      const BallSurfacePoint p = ball_surface(spine, s, static_cast<double>(side));
      const ScalarField& field = *pair.primaries[side].field();
      const std::array points{p.X};
      const FieldValues f = field.evaluate(Order::gradient, points);
      const Vec3 n = -f.gradient(0).normalized();
      EXPECT_LE(std::abs(f.value(0)), 1e-12);
      EXPECT_LE(p.Xs.cross(p.Xt).normalized().cross(n).norm(), 1e-11);
      EXPECT_LE((p.normal + n).norm(), 1e-11);  // d points from the ball, outside, into the solid
    }
  });
}

TEST(BallSurface, IsTheEnvelopeOfTheBall) {
  const Spine spine = loop(cylinders());
  for_all([&](Rng& rng) {
    const double s = uniform(rng, 0.0, spine.length()), t = uniform(rng, 0.0, 1.0);
    const SpinePoint ball = spine.at(s);
    const BallSurfacePoint p = ball_surface(spine, s, t);
    EXPECT_NEAR((p.X - ball.centre).norm(), spine.radius(), 1e-14);
    EXPECT_NEAR((p.X - ball.centre).dot(ball.tangent), 0.0, 1e-13);
    EXPECT_NEAR(p.normal.dot(p.Xs), 0.0, 1e-12);
    EXPECT_NEAR(p.normal.dot(p.Xt), 0.0, 1e-14);
    // Central differences, h = 1e-4: h^2/6 of third derivatives of about 10, and 1e-13/h of rounding.
    const double h = 1e-4;
    const Vec3 Xs = (ball_surface(spine, s + h, t).X - ball_surface(spine, s - h, t).X) / (2 * h);
    const Vec3 Xt = (ball_surface(spine, s, t + h).X - ball_surface(spine, s, t - h).X) / (2 * h);
    EXPECT_LE((p.Xs - Xs).norm(), 1e-7);
    EXPECT_LE((p.Xt - Xt).norm(), 1e-7);
  });
}

TEST(BallSurface, OfARightAngleIsAQuarterCylinder) {
  const double r = 0.2;
  const ScalarField wall = quadric_field({0, 0, 0, 0, 0, 0, 0, -1, 0, 0});
  const Spine spine =
      spine_near(fillet(BallPrimary(floor_field()), BallPrimary(wall), r), {0, r, r}, in_box(cube(1.0)));
  for (const SpinePoint& p : spine.points()) EXPECT_NEAR(p.arc.value, pi / 2, 1e-14);
  // Touch points r/tan(45 deg) = r from the edge, the centre r/sin(45 deg).
  EXPECT_NEAR(spine.points()[0].centre.tail<2>().norm(), r / std::sin(pi / 4), 1e-13);
  EXPECT_LE((ball_surface(spine, 1.0, 0.5).X.tail<2>() - Vec2::Constant(r * (1 - std::sqrt(0.5)))).norm(),
            1e-13);
}

TEST(BallBoundary, FollowsTheBallWithinItsTolerance) {
  const Spine spine = loop(cylinders());
  for (std::size_t side = 0; side < 2; ++side)
    for (const double tolerance : {1e-6, 1e-9}) {
      const BallBoundary edge = ball_boundary(spine, side, tolerance);
      EXPECT_LE(edge.deviation, tolerance);
      double off = 0.0, turned = 0.0;
      for (int k = 0; k < 200; ++k) {
        const double s = spine.length() * (k + 0.37) / 200.0;
        const BallSurfacePoint p = ball_surface(spine, s, static_cast<double>(side));
        off = std::max(off, (edge.line.jet(s).C() - p.X).norm());
        turned = std::max(turned, (edge.cross.jet(s).C() - p.Xt).norm());
        EXPECT_NEAR(edge.cross.jet(s).C().norm(), spine.radius() * spine.at(s).arc.value, 2 * tolerance);
      }
      // Between nodes the error is largest near the middle, where it was measured.
      EXPECT_LE(off, 2.0 * tolerance);
      EXPECT_LE(turned, 2.0 * tolerance);
    }
}

TEST(BallBoundary, MakesASweepBlendBetweenFields) {
  const BallPair pair = cylinders();
  const Spine spine = loop(pair);
  for (const Continuity continuity : {Continuity::G1, Continuity::G2}) {
    const BallBoundary from = ball_boundary(spine, 0, 1e-8), to = ball_boundary(spine, 1, 1e-8);
    BlendShape shape;
    const Blend blend = make_literal_blend(from.end(continuity), to.end(continuity), shape);
    for (int k = 0; k < 40; ++k) {
      const double v = spine.length() * (k + 0.2) / 40.0;
      for (int side = 0; side < 2; ++side) {
        const SurfaceJet j = blend.surface.jet({side == 0 ? 0.0 : 1.0, v});
        const std::array points{j.S};
        const FieldValues f =
            pair.primaries[static_cast<std::size_t>(side)].field()->evaluate(Order::hessian, points);
        const Vec3 n = -f.gradient(0).normalized();
        EXPECT_LE(std::abs(f.value(0)) / f.gradient(0).norm(), 1e-8);
        EXPECT_LE(unit_normal(j).cross(n).norm(), 1e-6);
        if (continuity != Continuity::G2) continue;
        const auto h = f.hessian(0);
        Eigen::Matrix3d H;
        H << h[0], h[3], h[4], h[3], h[1], h[5], h[4], h[5], h[2];
        const Vec3 T = j.Su.normalized();
        EXPECT_NEAR(normal_curvature(j, T, n), T.dot(H * T) / f.gradient(0).norm(), 1e-5);
      }
    }
  }
}

TEST(BallTrimline, LiesOnItsPrimaryAndClosesWithIt) {
  const BallPair pair = surfaces();
  const Spine spine = loop(pair);
  EXPECT_TRUE(spine.closed());
  EXPECT_NEAR(spine.length(), 5.50459712914205, 1e-9);
  // Around the cylinder about z the angle gains one turn, on the other none.
  EXPECT_NEAR(std::abs(spine.turns()[1][1]), 2.0 * pi, 1e-12);
  EXPECT_EQ(spine.turns()[0].norm(), 0.0);
  for (std::size_t side = 0; side < 2; ++side) {
    const Trimline line = ball_trimline(spine, side, 1e-9);
    EXPECT_TRUE(line.domain().closed);
    for (int k = 0; k < 100; ++k) {
      const double s = spine.length() * (k + 0.41) / 100.0;
      EXPECT_LE((line.jet(s).C() - spine.at(s).feet[side].point).norm(), 2e-9);
    }
  }
  EXPECT_THROW(static_cast<void>(ball_trimline(loop(cylinders()), 0, 1e-9)), GeometryError);
}

TEST(BallTrimline, OfTheExactArcHasItsSweepBlendNearby) {
  // Cubic-like blends of a quarter arc with the arc's length as tangent miss it by 0.027 % of the radius at
  // least; the wildest arc here is below 100 deg.
  const Spine spine = loop(surfaces());
  BlendSpec spec;
  spec.correspondence = {CorrespondenceRule::as_given, false, {}};
  const Blend blend = make_blend(ball_trimline(spine, 0, 1e-9), ball_trimline(spine, 1, 1e-9), spec, 1e-6);
  double worst = 0.0;
  for (int k = 0; k < 50; ++k)
    for (int i = 1; i < 8; ++i) {
      const double v = spine.length() * k / 50.0;
      const Vec3 x = blend.surface.jet({i / 8.0, v}).S;
      worst = std::max(worst, std::abs((x - spine.at(spine.nearest(x)).centre).norm() - spine.radius()));
    }
  EXPECT_LE(worst, 0.1 * spine.radius());
  EXPECT_GT(worst, 1e-6);
}

}  // namespace
}  // namespace blendwright
