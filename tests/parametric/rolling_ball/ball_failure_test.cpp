// Every named cause why a ball cannot roll.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"
#include "tests/parametric/rolling_ball/ball_scenes.hpp"

namespace blendwright {
namespace {

using namespace test;
using Cause = BallFailure::Cause;
using ::testing::HasSubstr;

std::vector<Cause> causes(const SpineSet& set) {
  std::vector<Cause> found;
  for (const BallFailure& f : set.failures) found.push_back(f.cause);
  return found;
}

TEST(BallFailure, TangentWhereTheSpineCrossesItself) {
  // Cylinders of the same radius: their spines cross where both normals are (0, +-1, 0).
  const BallPair pair =
      fillet(BallPrimary(cylinder_field(0.8, 0)), BallPrimary(cylinder_field(0.8, 2)), 0.25);
  const SpineSet set = find_spines(pair, in_box(cube(2.0)));
  ASSERT_FALSE(set.spines.empty());
  EXPECT_THAT(causes(set), ::testing::Contains(Cause::tangent));
  for (const BallFailure& f : set.failures) {
    if (f.cause != Cause::tangent) continue;
    EXPECT_LE((f.at.cwiseAbs() - Vec3(0, 1.05, 0)).norm(), 1e-3);
    EXPECT_THAT(f.message, HasSubstr("parallel"));
  }
  // Its neighbours do not cross.
  const BallPair larger =
      fillet(BallPrimary(cylinder_field(0.85, 0)), BallPrimary(cylinder_field(0.8, 2)), 0.25);
  EXPECT_TRUE(find_spines(larger, in_box(cube(2.0))).failures.empty());
}

TEST(BallFailure, TangentWhereTheSpineShrinksToAPoint) {
  // |h - r| = R + r: the ball fits between sphere and floor at one place only.
  const double R = 1.0, r = 0.3, h = R + 2.0 * r;
  const BallPair pair = fillet(BallPrimary(sphere_field(R, {0, 0, h})), BallPrimary(floor_field()), r);
  const SpineSet set = find_spines(pair, in_box(cube(2.0)));
  EXPECT_TRUE(set.spines.empty());
  ASSERT_FALSE(set.failures.empty());
  EXPECT_EQ(set.failures.back().cause, Cause::tangent) << set.failures.back().message;
}

TEST(BallFailure, CurvatureWhereTheBallIsLargerThanTheHollow) {
  // The trough z = a x^2 has the radius of curvature 1/(2a) at its bottom, which the spine along the wall
  // y = 0.6 x comes down to.
  const double a = 1.5, r = 0.45;                                             // 1/(2a) = 0.333 < r
  const ScalarField trough = quadric_field({a, 0, 0, 0, 0, 0, 0, 0, -1, 0});  // z <= a x^2
  const ScalarField wall = quadric_field({0, 0, 0, 0, 0, 0, 0.6, -1, 0, 0});  // y >= 0.6 x is outside
  const BallPair pair = fillet(BallPrimary(trough), BallPrimary(wall), r);
  const SpineSet set = find_spines(pair, in_box(cube(3.0)));
  EXPECT_THAT(causes(set), ::testing::Contains(Cause::curvature));
  for (const BallFailure& f : set.failures)
    if (f.cause == Cause::curvature) {
      EXPECT_THAT(f.message, HasSubstr("smaller radius"));
    }
  // A ball that fits rolls through.
  const BallPair smaller = fillet(BallPrimary(trough), BallPrimary(wall), 0.3);
  const SpineSet through = find_spines(smaller, in_box(cube(3.0)));
  EXPECT_EQ(through.spines.size(), 1u);
  EXPECT_TRUE(through.failures.empty());
}

TEST(BallFailure, NoSpineWhereNothingIsReached) {
  const BallPair pair = fillet(BallPrimary(sphere_field(0.5, {0, 0, 3})), BallPrimary(floor_field()), 0.3);
  const SpineSet set = find_spines(pair, in_box(cube(4.0)));
  EXPECT_TRUE(set.spines.empty());
  EXPECT_THAT(causes(set), ::testing::ElementsAre(Cause::no_spine));
  EXPECT_STREQ(name(set.failures[0].cause), "no_spine");
  EXPECT_THROW(static_cast<void>(spine_near(pair, {0.5, 0, 1}, in_box(cube(4.0)))), GeometryError);
}

TEST(BallFailure, InterferenceWithAnotherPart) {
  const BallPair pair = fillet(BallPrimary(sphere_field(1, {0, 0, 0.3})), BallPrimary(floor_field()), 0.25);
  // The spine has the radius sqrt(1.25^2 - 0.05^2) = 1.249 at z = 0.25. A post beside it, 0.1 in the ball.
  const double x = std::sqrt(1.25 * 1.25 - 0.05 * 0.05);
  SpineSpec spec = in_box(cube(2.5));
  spec.others = {BallPrimary(sphere_field(0.2, {x + 0.35, 0, 0.25}))};
  const SpineSet set = find_spines(pair, spec);
  ASSERT_EQ(set.spines.size(), 1u);
  ASSERT_TRUE(set.spines[0].interference);
  EXPECT_THAT(causes(set), ::testing::ElementsAre(Cause::interference));
  // Steps are sqrt(8 0.00025 x) = 0.05 long, so that a traced point is within 0.02 rad of the post's
  // direction; the gap is larger there by x (x + 0.35) 0.02^2/(2 0.35) = 1.2e-3.
  EXPECT_NEAR(set.failures[0].depth, 0.1, 2e-3);
  EXPECT_LE((set.failures[0].at - Vec3(x, 0, 0.25)).norm(), 0.05);
  // Just beside it there is none.
  spec.others = {BallPrimary(sphere_field(0.2, {x + 0.46, 0, 0.25}))};
  EXPECT_FALSE(find_spines(pair, spec).spines[0].interference);
}

TEST(BallFailure, InterferenceWithThePrimaryItself) {
  // A slot: floor, and a wall with a second wall opposite, nearer than the ball is wide.
  std::vector<NodeSpec> nodes{quadric("left", {0, 0, 0, 0, 0, 0, 0, -1, 0, 0}),     // y <= 0
                              quadric("right", {0, 0, 0, 0, 0, 0, 0, 1, 0, -0.5}),  // y >= 0.5
                              part("walls", "max", {{"of", refs({"left", "right"})}})};
  for (const double r : {0.2, 0.3}) {
    const BallPair pair = fillet(BallPrimary(field_of(nodes)), BallPrimary(floor_field()), r);
    const Spine spine = spine_near(pair, {0, r, r}, in_box({{-1, -0.1, -0.1}, {1, 0.6, 1}}));
    EXPECT_EQ(spine.interference.has_value(), r > 0.25);
    if (spine.interference) {
      EXPECT_NEAR(spine.interference->depth, 0.1, 1e-9);
    }
  }
}

TEST(LargestRadius, IsThatOfTheSlot) {
  std::vector<NodeSpec> nodes{quadric("left", {0, 0, 0, 0, 0, 0, 0, -1, 0, 0}),
                              quadric("right", {0, 0, 0, 0, 0, 0, 0, 1, 0, -0.5}),
                              part("walls", "max", {{"of", refs({"left", "right"})}})};
  const BallPair pair = fillet(BallPrimary(field_of(nodes)), BallPrimary(floor_field()), 0.4);
  const auto r = largest_radius(pair, {0, 0.1, 0.1}, in_box({{-1, -0.1, -0.1}, {1, 0.6, 1}}));
  ASSERT_TRUE(r);
  EXPECT_NEAR(*r, 0.25, 0.0026);  // to 1 %
  EXPECT_LE(*r, 0.25 + 1e-9);
}

}  // namespace
}  // namespace blendwright
