// Criteria of the scenes s3-*: perturbations, offsets, classic blends, bodies and their contacts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "implicit/offset/offset_error.hpp"
#include "implicit/polygonize/polygonize.hpp"
#include "implicit/relations/collision.hpp"
#include "implicit/relations/set_relation.hpp"
#include "tests/implicit/scenes/example_scene.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

double volume_of(const ScalarField& field, int cells) {
  MeshOptions options;
  options.cell = field.bounds()->size().maxCoeff() / cells;
  return polygonize(field, options).facts.volume;
}

/// The octant of the ellipsoid 3, 2, 1 by latitude and azimuth, 24 x 24 points.
std::vector<Vec3> ellipsoid_octant() {
  std::vector<Vec3> points;
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 24; ++j) {
      const double u = 0.5 * std::numbers::pi * i / 23, v = 0.5 * std::numbers::pi * j / 23;
      points.push_back({3 * std::sin(u) * std::cos(v), 2 * std::sin(u) * std::sin(v), std::cos(u)});
    }
  return points;
}

TEST(SceneS3Offsets, OfTheEllipsoidErrAsTheTableSays) {
  const ExampleScene scene("s3-offsets");
  const ScalarField ellipsoid = scene.field("ellipsoid");
  const auto error = [&](const std::string& solid, double distance) {
    return offset_error(ellipsoid, scene.field(solid), distance, ellipsoid_octant());
  };
  // Within 1 % of the printed figures; along the normal max / rms.
  EXPECT_NEAR(std::abs(error("normal+0.1", 0.1).worst), 5.30e-4, 0.01 * 5.30e-4);
  EXPECT_NEAR(error("normal+0.1", 0.1).rms, 1.44e-4, 0.01 * 1.44e-4);
  EXPECT_NEAR(std::abs(error("normal+0.3", 0.3).worst), 1.29e-2, 0.01 * 1.29e-2);
  EXPECT_NEAR(std::abs(error("value+0.2", 0.3).worst), 2.05e-1, 0.01 * 2.05e-1);
  for (const double distance : {0.3, -0.3}) {
    const OffsetError e = error(distance > 0 ? "ellipsoid+0.3" : "ellipsoid-0.3", distance);
    EXPECT_LE(std::abs(e.worst), 1e-12) << distance;
    EXPECT_EQ(e.samples, 576u);
  }
}

TEST(SceneS3Offsets, HaveTheVolumesOfSteinersFormula) {
  const ExampleScene scene("s3-offsets");
  const double pi = std::numbers::pi;
  // V + S d + (mean curvature) d^2 + 4/3 pi d^3 for the box with half sizes 1, 0.8, 0.6: edges 4 (2 + 1.6
  // + 1.2).
  const double d = 0.3, box = 8 * 1 * 0.8 * 0.6, area = 8 * (0.8 + 0.6 + 0.48), edges = 4 * (2 + 1.6 + 1.2);
  const double grown = box + area * d + edges * 0.25 * pi * d * d + 4.0 / 3.0 * pi * d * d * d;
  // Triangles cut the rounded parts by about (cell/r)^2/8 of their height: below 1e-3 of the volume at 96
  // cells.
  EXPECT_NEAR(volume_of(scene.field("box+0.3"), 96), grown, 1e-3 * grown);
  EXPECT_NEAR(volume_of(scene.field("box-0.3"), 96), 8 * 0.7 * 0.5 * 0.3, 1e-2 * 0.84);
  EXPECT_NEAR(volume_of(scene.field("rounded-box"), 96), 3.68589966375522, 1e-3 * 3.7);
  EXPECT_NEAR(volume_of(scene.field("ring+0.3"), 96), 2 * pi * pi * 2 * 0.9 * 0.9, 2e-3 * 32);
}

TEST(SceneS3SmallBall, GrowsWithoutAHole) {
  const ExampleScene scene("s3-small-ball");
  const ScalarField grown = scene.field("by-a-ball");
  EXPECT_NEAR(grown.value(Vec3::Zero()), 0.04, 1e-15);
  EXPECT_GT(grown.value(Vec3(0.5, 0, 0)), 0.0);
  EXPECT_NEAR(grown.value(Vec3(1.2, 0, 0)), 0.0, 1e-13);
  // The probe along the normal goes through the ball and out on its far side.
  SceneSpec spec = scene.spec();
  spec.strict = false;
  spec.nodes.push_back(
      {.name = "normal", .kind = "normal_offset", .values = {{"of", NodeRef{"ball"}}, {"distance", 1.0}}});
  EXPECT_NEAR(ExampleScene(spec).field("normal").value(Vec3(0.5, 0, 0)), -0.21, 1e-14);
}

TEST(SceneS3RightAngle, IsTheCircleOfARollingBall) {
  const ScalarField circle = ExampleScene("s3-right-angle").field("circle");
  for_all([&](Rng& rng) {
    // Points of the arc about (1, 1): on the surface, and beside it on their sides.
    const double angle = uniform(rng, std::numbers::pi, 1.5 * std::numbers::pi);
    const auto at = [&](double r) {
      return Vec3(1 + r * std::cos(angle), 1 + r * std::sin(angle), uniform(rng, -1, 1));
    };
    EXPECT_NEAR(circle.value(at(1.0)), 0.0, 1e-12);
    EXPECT_LT(circle.value(at(1.0 - 1e-9)), 0.0);
    EXPECT_GT(circle.value(at(1.0 + 1e-9)), 0.0);
    // The closing of the right angle by a ball of radius 1.
    const double x = uniform(rng, -1, 2), y = uniform(rng, -1, 2);
    const bool closed = x <= 0 || y <= 0 || (x < 1 && y < 1 && std::hypot(x - 1, y - 1) >= 1);
    EXPECT_EQ(circle.value(Vec3(x, y, 0)) >= 0, closed) << x << ", " << y;
  });
}

TEST(SceneS3Tee, MovesTheSurfaceByTheSuperEllipse) {
  const ExampleScene scene("s3-tee");
  const ScalarField run = scene.field("run"), branch = scene.field("branch"), blend = scene.field("w=2");
  for_all([&](Rng& rng) {
    const Vec3 p(uniform(rng, -12, 12), uniform(rng, -12, 12), uniform(rng, 0, 14));
    const double a = -run.value(p), b = -branch.value(p), h = -blend.value(p);
    // sum ((1 - (a_i - h)/4)+)^2 = 1: the figure of the operator, whatever the operands are.
    const auto term = [&](double x) { return std::pow(std::max(0.0, 1 - (x - h) / 4.0), 2); };
    EXPECT_NEAR(term(a) + term(b), 1.0, 1e-11);
    EXPECT_LE(h, std::min(a, b) + 1e-12);
  });
  // Sharper with w; never less than the sharp union.
  const double w1 = volume_of(scene.field("w=1"), 64), w2 = volume_of(blend, 64),
               w4 = volume_of(scene.field("w=4"), 64);
  EXPECT_GT(w1, w2);
  EXPECT_GT(w2, w4);
}

TEST(SceneS3Material, IsAddedAndRemovedWhereItShould) {
  const ExampleScene scene("s3-material");
  const double sharp = volume_of(scene.field("sharp"), 64), added = volume_of(scene.field("added"), 64),
               removed = volume_of(scene.field("removed"), 64), part = volume_of(scene.field("one-side"), 64);
  EXPECT_GT(added, part);
  EXPECT_GT(part, sharp);
  EXPECT_LT(removed, sharp);
  // Outside the ball about (5, 0, 3) the bounded blend is the union, bit for bit.
  const ScalarField bounded = scene.field("one-side"), plain = scene.field("sharp");
  for_all([&](Rng& rng) {
    const Vec3 p(uniform(rng, -18, 18), uniform(rng, -14, 14), uniform(rng, -5, 18));
    if ((p - Vec3(5, 0, 3)).norm() > 9.0) {
      EXPECT_EQ(bounded.value(p), plain.value(p));
    }
  });
}

TEST(SceneS3Bridge, JoinsWhatDoesNotMeet) {
  const ExampleScene scene("s3-bridge");
  for (const char* solid : {"super-elliptic", "material"})
    EXPECT_GT(scene.field(solid).value(Vec3::Zero()), 0.0) << solid;
  EXPECT_EQ(collide(scene.field("left"), scene.field("right"), {}).contact, Contact::disjoint);
}

TEST(SceneS3Balls, AreDecidedAtAMillionth) {
  const ExampleScene scene("s3-balls");
  const ScalarField ball = scene.field("ball");
  const Vec3 u(0.6, 0.48, 0.64);
  const ScalarField other = scene.field("apart");
  const Collision apart = with_nearest_place(collide(ball, other, {}), ball, other);
  EXPECT_EQ(apart.contact, Contact::disjoint);
  EXPECT_LE(apart.boxes, 1000u);
  ASSERT_TRUE(apart.gap && apart.normal);
  EXPECT_NEAR(*apart.gap, 1e-6, 1e-11);  // first order: relative error of the gap's own size
  EXPECT_NEAR((*apart.normal - u).norm(), 0.0, 1e-5);
  const Collision touching = collide(ball, scene.field("touching"), {});
  EXPECT_EQ(touching.contact, Contact::contact);
  ASSERT_TRUE(touching.point && touching.gap);
  EXPECT_GE(ball.value(*touching.point), 0.0);
  EXPECT_GE(scene.field("touching").value(*touching.point), 0.0);
  EXPECT_NEAR(*touching.gap, -1e-6, 1e-11);
  EXPECT_NEAR((*touching.point - (1 - 5e-7) * u).norm(), 0.0, 1e-3);
}

TEST(SceneS3Ring, IsDecidedAlongAWholeCircle) {
  const ExampleScene scene("s3-ring");
  const Collision apart = collide(scene.field("thin"), scene.field("wide-ring"), {});
  EXPECT_EQ(apart.contact, Contact::disjoint);  // R - r - a = 0.01
  const Collision touching = collide(scene.field("thick"), scene.field("tight-ring"), {});
  EXPECT_EQ(touching.contact, Contact::contact);  // -1e-5
  ASSERT_TRUE(touching.point);
  EXPECT_NEAR(touching.point->head<2>().norm(), 0.765, 1e-3);
}

TEST(SceneS3Mirror, IsDecidedByItsPlane) {
  const ExampleScene scene("s3-mirror");
  const ScalarField body = scene.field("body");
  EXPECT_NEAR(body.value(Vec3(1.2124557763288396, 0, 0)), 0.0, 1e-14);
  const ScalarField other = scene.field("apart");
  const Collision apart = with_nearest_place(collide(body, other, {}), body, other);
  EXPECT_EQ(apart.contact, Contact::disjoint);
  ASSERT_TRUE(apart.gap);
  EXPECT_NEAR(*apart.gap, 1e-4, 1e-6);
  EXPECT_EQ(collide(body, scene.field("touching"), {}).contact, Contact::contact);
}

TEST(SceneS3Depth, TrapsBarsAndNothingElse) {
  const ExampleScene scene("s3-depth");
  // Without their bounds, which alone tell them apart.
  const auto unbounded = [&](const char* name) {
    const ScalarField f = scene.field(name);
    return ScalarField(f.shared_model(), f.level());
  };
  const ScalarField front = unbounded("front"), back = unbounded("back");
  const Box domain{Vec3::Constant(-1), Vec3::Constant(1)};
  EXPECT_EQ(collide(front, back, {.domain = domain, .combination = false}).contact, Contact::disjoint);
  const Collision with = collide(front, back, {.domain = domain});
  EXPECT_EQ(with.contact, Contact::disjoint);
  EXPECT_LE(with.boxes, 8u);
  const Collision bars =
      collide_projected(front, back, 2, {.tolerance = 0.02, .domain = domain, .combination = false});
  EXPECT_EQ(bars.contact, Contact::undecided);
}

TEST(SceneS3Bumps, ChangeNothingOutsideTheirSupports) {
  const ExampleScene scene("s3-bumps");
  const ScalarField ball = scene.field("ball");
  for (const char* solid : {"power=2", "power=3"}) {
    const ScalarField body = scene.field(solid);
    // The far side of the ball is in no bump's support.
    for_all([&](Rng& rng) {
      const Vec3 p(uniform(rng, -25, -12), uniform(rng, 0, 20), uniform(rng, -20, 5));
      EXPECT_EQ(body.value(p), ball.value(p));
    });
    EXPECT_GT(body.value(Vec3(21, 0, 0)), 0.0);   // a bump
    EXPECT_LT(body.value(Vec3(3, -19, 3)), 0.0);  // a dent
  }
}

}  // namespace
}  // namespace blendwright::test
