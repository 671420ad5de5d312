// What a scene says about its field is true of the field.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "implicit/scene/scene.hpp"
#include "kernel/base/error.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"
#include "tests/implicit/support/random_scene.hpp"

namespace blendwright::test {
namespace {

using Numbers = std::vector<double>;

Vec3 random_point(Rng& rng, double reach) {
  return {uniform(rng, -reach, reach), uniform(rng, -reach, reach), uniform(rng, -reach, reach)};
}

/// Largest |f(aX) - a f(X)| relative to a f(X), over random X and a, seen from the origin of ray-linearity.
double defect_of_rays(const Scene& scene, Rng& rng) {
  double worst = 0.0;
  for (int i = 0; i < 50; ++i) {
    const Vec3 x = random_point(rng, 3.0);
    const double a = std::ldexp(1.0, integer(rng, -4, 4));
    const double f = a * scene.field.value(scene.origin + x),
                 scaled = scene.field.value(scene.origin + a * x);
    if (f != scaled) worst = std::max(worst, std::abs(scaled - f) / std::max(f, 1e-300));
  }
  return worst;
}

// Distances lose up to 1e-14 of their value (two digits), and so do coordinates next to an origin that was
// moved by 1, at 1/16 of the way; distance operations pass errors on, an erosion enlarges them by (E/d)^n, up
// to 1e3 in 50 points.
TEST(RayLinearity, IsClaimedOnlyWhereItHolds) {
  int claimed = 0;
  for_all(
      [&](Rng& rng) {
        const Scene scene = build_scene(random_scene(rng, Level::one, 2));
        if (!scene.ray_linear) return;
        ++claimed;
        EXPECT_LE(defect_of_rays(scene, rng), 1e-9);
      },
      300);
  EXPECT_GE(claimed, 30);
}

// The counter example of the formula sheet: d(2X)/d(X) = 3.1773.
TEST(RayLinearity, IsNotClaimedForSegments) {
  const Scene scene = build_scene(scene_of({part(
      "rod", "segment_skeleton", {{"p0", Numbers{-3, 0, 0}}, {"p1", Numbers{4, 0, 0}}, {"radius", 5.0}})}));
  EXPECT_FALSE(scene.ray_linear);
  const Vec3 x(5, 2, 0.5);
  EXPECT_NEAR(scene.field.value(2.0 * x) / scene.field.value(x), 3.1773, 5e-5);
}

TEST(RayLinearity, IsNotClaimedForDifferencesAndFields) {
  const std::vector<NodeSpec> balls = {ball("a", 2.0), ball("b", 3.0)};
  const auto with = [&](NodeSpec last) {
    std::vector<NodeSpec> nodes = balls;
    nodes.push_back(std::move(last));
    return build_scene(scene_of(std::move(nodes))).ray_linear;
  };
  EXPECT_TRUE(with(part("x", "ricci_union_one", {{"of", refs({"a", "b"})}, {"n", 3.0}})));
  EXPECT_FALSE(with(part("x", "ricci_difference_one", {{"of", refs({"a", "b"})}, {"n", 3.0}})));
  EXPECT_FALSE(with(part("x", "complement", {{"of", ref("a")}})));
  EXPECT_FALSE(with(soft("x", "a")));
  EXPECT_FALSE(with(part("x", "zero_level", {{"of", ref("a")}})));
}

// A placed ray-linear function is one about the preimage of its origin, where other functions with the same
// placement meet it; elsewhere they do not.
TEST(Origins, MoveWithPlacements) {
  const auto scene = [](Numbers first, Numbers second) {
    return scene_of(
        {ball("big", 4.0), ball("small", 1.0), part("p", "place", {{"of", ref("big")}, {"move", first}}),
         part("q", "place",
              {{"of", ref("small")}, {"move", second}, {"turn_deg", 30.0}, {"axis", Numbers{1, 2, 3}}}),
         part("x", "erosion", {{"of", ref("p")}, {"by", ref("q")}, {"n", 1.0}})});
  };
  EXPECT_THAT(problems_of(scene({1, 2, 3}, {1, 2, 3})), testing::IsEmpty());
  EXPECT_THAT(problems_of(scene({1, 2, 3}, {1, 2, 3.001})).at(0).message,
              testing::HasSubstr("OriginMismatch"));
  const Scene built = build_scene(scene({1, 2, 3}, {1, 2, 3}));
  EXPECT_NEAR(built.field.value(Vec3(1, 2, 3) + Vec3(0, 3, 0)), 1.0, 1e-14);
}

TEST(Placement, ScalesTurnsAndMovesTheObject) {
  const Scene scene = build_scene(scene_of(
      {part("egg", "lp_metric", {{"a", 3.0}, {"b", 1.0}, {"c", 1.0}, {"n", 2.0}}),
       part("x", "place",
            {{"of", ref("egg")}, {"move", Numbers{10, 0, 0}}, {"turn_deg", 90.0}, {"scale", 2.0}})}));
  EXPECT_NEAR(scene.field.value(Vec3(10, 6, 0)), 1.0, 1e-14);  // the long axis, turned from x to y
  EXPECT_NEAR(scene.field.value(Vec3(12, 0, 0)), 1.0, 1e-14);
  EXPECT_NEAR(scene.field.value(Vec3(10, 0, 2)), 1.0, 1e-14);
  ASSERT_TRUE(scene.field.bounds());
  EXPECT_TRUE(scene.field.bounds()->contains(Vec3(10, 6, 0)));
  EXPECT_NEAR(scene.field.bounds()->hi.y(), 6.0, 1e-9);
}

// The logarithm makes 1/x the negative; the difference keeps the shape of x.
TEST(ZeroLevel, HasTheSameSurface) {
  for (const std::string form : {"difference", "logarithm"}) {
    const Scene scene =
        build_scene(scene_of({ball("b", 2.0), part("x", "zero_level", {{"of", ref("b")}, {"form", form}})}));
    EXPECT_EQ(scene.field.level(), Level::zero);
    EXPECT_EQ(scene.field.value(Vec3(2, 0, 0)), 0.0);
    EXPECT_DOUBLE_EQ(scene.field.value(Vec3(4, 0, 0)), form == "difference" ? 1.0 : std::log(2.0));
    EXPECT_NEAR(scene.field.value(Vec3::Zero()), form == "difference" ? -1.0 : std::log(1e-100), 1e-12);
    ASSERT_TRUE(scene.field.bounds());
    EXPECT_NEAR(scene.field.bounds()->hi.z(), 2.0, 1e-9);
  }
}

// An erosion by something larger is infinite everywhere, and so is its range.
TEST(ZeroLevel, OfInfinityIsInfinite) {
  SceneSpec spec =
      scene_of({ball("b", 2.0), ball("larger", 3.0),
                part("e", "erosion", {{"of", ref("b")}, {"by", ref("larger")}, {"n", 2.0}}),
                part("x", "zero_level", {{"of", ref("e")}, {"form", std::string("logarithm")}})});
  spec.strict = false;
  const Scene scene = build_scene(spec);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(scene.field.value(Vec3(1, 2, 3)), infinity);
  EXPECT_EQ(scene.field.range({Vec3(1.5, 1.5, 1.5), Vec3(1.6, 1.6, 1.6)}), (Range{infinity, infinity}));
}

TEST(Members, AreSoftObjectsAndBareDistances) {
  const auto members = [](SceneSpec spec) { return build_scene(spec).field.members(); };
  const std::vector<NodeSpec> nodes = {
      ball("a", 2.0), ball("b", 1.0), soft("sa", "a"), soft("sb", "b"),
      part("e", "erosion", {{"of", ref("a")}, {"by", ref("b")}, {"n", 1.0}})};
  const auto with = [&](NodeSpec last) {
    std::vector<NodeSpec> all = nodes;
    all.push_back(std::move(last));
    return scene_of(std::move(all));
  };
  EXPECT_EQ(members(with(part("x", "max", {{"of", refs({"sa", "sb"})}}))),
            (std::vector<std::string>{"sa", "sb"}));
  EXPECT_EQ(members(with(part("x", "max", {{"of", refs({"sb", "sb"})}}))), (std::vector<std::string>{"sb"}));
  EXPECT_EQ(members(with(part("x", "min", {{"of", refs({"b", "e"})}}))),
            (std::vector<std::string>{"b", "e"}));
  EXPECT_EQ(members(with(soft("x", "e"))), (std::vector<std::string>{"x"}));
}

TEST(Members, AreNearestWhereTheirSurfaceIs) {
  const Scene scene =
      build_scene(scene_of({ball("a", 2.0), soft("left", "a"), soft("still", "a"),
                            part("right", "place", {{"of", ref("still")}, {"move", Numbers{3, 0, 0}}}),
                            part("x", "soft_blend", {{"of", refs({"left", "right"})}})}));
  EXPECT_EQ(scene.field.members(), (std::vector<std::string>{"left", "still"}));
  const std::vector<double> x = {0.9, 2.1, -1.1, 4.2}, y = {0, 0, 0, 0};
  std::vector<std::uint32_t> nearest(4);
  scene.field.model().nearest_member({x, y, y}, nearest);
  EXPECT_THAT(nearest, testing::ElementsAre(0, 1, 0, 1));
}

TEST(Regions, HoldEveryPointInside) {
  int bounded_scenes = 0, outside = 0;
  for_all(
      [&](Rng& rng) {
        const Scene scene = build_scene(random_scene(rng));
        if (!scene.field.bounds()) return;
        ++bounded_scenes;
        const Box& box = *scene.field.bounds();
        // Rounding of values next to the surface may move a point by some ulp of its coordinates.
        const double slack = 1e-9 * (1.0 + box.lo.norm() + box.hi.norm());
        for (int i = 0; i < 400; ++i) {
          const double reach = log_uniform(rng, 0.5, 3.0);
          const Vec3 p = box.centre() + reach * random_point(rng, 1.0).cwiseProduct(0.5 * box.size());
          if (((p - box.lo).array() >= -slack).all() && ((box.hi - p).array() >= -slack).all()) continue;
          ++outside;
          EXPECT_LE(inside(scene.field.level(), scene.field.value(p)), 0.0)
              << p.transpose() << " box " << box.lo.transpose() << " .. " << box.hi.transpose();
        }
      },
      300);
  EXPECT_GE(bounded_scenes, 100);
  EXPECT_GE(outside, 10'000);
}

TEST(Regions, OfSoftObjectsAreTight) {
  const auto hi = [](NodeSpec object) {
    const Scene scene = build_scene(scene_of({ball("b", 4.0), ball("c", 5.0), std::move(object)}));
    return scene.field.bounds().value().hi.x();
  };
  EXPECT_NEAR(hi(soft("x", "b")), 2.0, 1e-9);
  EXPECT_NEAR(hi(part("x", "soft_object", {{"distance", ref("b")}, {"w1", 0.3}, {"w2", 0.2}})), 2.0, 1e-9);
  EXPECT_NEAR(hi(part("x", "soft_object", {{"distance", ref("b")}, {"w1", ref("c")}})), 2.0, 1e-9);
  EXPECT_NEAR(hi(part("x", "soft_object", {{"distance", ref("b")}, {"potential", std::string("wyvill")}})),
              2.0, 1e-9);
}

// Every kind of node, and scenes of many, through the suite of all evaluators.
TEST(RandomScenes, PassTheEvaluatorSuite) {
  for_all(
      [](Rng& rng) {
        const SceneSpec spec = random_scene(rng);
        SCOPED_TRACE(testing::PrintToString(spec.solid));
        const Scene scene = build_scene(spec);
        // Steep exponents and creases make many differences useless; the bodies' own tests compare theirs.
        EXPECT_EQ(evaluator_faults(scene.field, {.points = 60,
                                                 .boxes = 20,
                                                 .samples = 30,
                                                 .agreement = agreement_of(spec),
                                                 .useless_share = 1.0}),
            no_faults);
      },
      60);
}

TEST(RandomScenes, AreThereForEveryKind) {
  for (const NodeKind* kind : node_kinds()) {
    if (!RandomScene::makes(kind->family)) continue;
    SCOPED_TRACE(kind->name);
    for_all(
        [&](Rng& rng) {
          const SceneSpec spec = random_scene_of(rng, *kind);
          EXPECT_EQ(find_node_kind(spec.nodes.back().kind), kind);
          EXPECT_THAT(problems_of(spec), testing::IsEmpty());
        },
        20);
  }
}

}  // namespace
}  // namespace blendwright::test
