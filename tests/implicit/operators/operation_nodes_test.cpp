// The rows of operators and distance operations, in scenes: what they refuse, the facts of their nodes,
// bounds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "implicit/scene/direction_scan.hpp"
#include "tests/implicit/operators/operator_names.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"
#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

auto problem(const std::string& where, const std::string& start, const std::string& part) {
  return AllOf(Field(&Problem::where, where),
               Field(&Problem::message, AllOf(StartsWith(start), HasSubstr(part))));
}
NodeSpec ellipsoid(std::string name, double a, double b, double c, double n = 2.0) {
  return part(std::move(name), "lp_metric", {{"a", a}, {"b", b}, {"c", c}, {"n", n}});
}
NodeSpec moved(std::string name, const std::string& of, const Vec3& by) {
  return part(std::move(name), "place",
              {{"of", ref(of)}, {"move", std::vector<double>{by.x(), by.y(), by.z()}}});
}

TEST(OperationNode, RefusesOperandsOfAnotherLevel) {
  EXPECT_THAT(
      problems_of(
          scene_of({ball("d", 1), soft("f", "d"), part("x", "soft_blend", {{"of", refs({"f", "d"})}})})),
      ElementsAre(problem("/nodes/x/of/1", "LevelMismatch", "is of one level, must be of half level")));
  EXPECT_THAT(
      problems_of(scene_of({ball("d", 1), soft("f", "d"), part("x", "min", {{"of", refs({"d", "f"})}})})),
      ElementsAre(
          problem("/nodes/x/of/1", "LevelMismatch", "must be of one level, as the first operand is")));
  EXPECT_THAT(problems_of(scene_of(
                  {part("p", "plane", {{"normal", std::vector<double>{0, 0, 1}}, {"a", 1.0}}), ball("d", 1),
                   part("x", "ricci_union_one", {{"of", refs({"p", "d"})}, {"n", 2.0}})})),
              ElementsAre(problem("/nodes/x/of/0", "LevelMismatch", "signed")));
  EXPECT_THAT(
      problems_of(scene_of({ball("d", 1), soft("f", "d"),
                            part("x", "dilation", {{"of", ref("d")}, {"by", ref("f")}, {"n", 1.0}})})),
      ElementsAre(problem("/nodes/x/by", "LevelMismatch", "is of half level")));
}

TEST(OperationNode, RefusesParametersWithoutABlend) {
  const auto scale = [](double r1, double p) {
    return scene_of(
        {ball("d", 1), soft("f", "d"), soft("g", "d"),
         part("x", "scale_union_half", {{"of", refs({"f", "g"})}, {"r1", r1}, {"r2", 0.5}, {"p", p}})});
  };
  EXPECT_THAT(problems_of(scale(1.0, 0.25)), IsEmpty());
  EXPECT_THAT(problems_of(scale(1.2, 0.0)),
              ElementsAre(problem("/nodes/x/r1", "InvalidParameter", "must be <= 1")));
  EXPECT_THAT(problems_of(scale(1.0, 0.5)),
              ElementsAre(problem("/nodes/x/p", "InvalidParameter", "must be <= r1 r2 (1 - 1e-6)")));
}

TEST(DistanceOperation, NeedsRayLinearOperandsAboutOnePoint) {
  const NodeSpec skeleton =
      part("s", "segment_skeleton",
           {{"p0", std::vector<double>{0, 0, 0}}, {"p1", std::vector<double>{1, 0, 0}}, {"radius", 1.0}});
  for (const char* kind : {"dilation", "erosion", "ray_scaling"}) {
    const Values values{{"of", ref("d")}, {"by", ref("s")}, {"n", 1.0}};
    EXPECT_THAT(problems_of(scene_of({ball("d", 3), skeleton, part("x", kind, values)})),
                ElementsAre(problem("/nodes/x/by", "NotRayLinear", "must be")));
    const Values other{{"of", ref("d")}, {"by", ref("m")}, {"n", 1.0}};
    EXPECT_THAT(problems_of(scene_of(
                    {ball("d", 3), ball("e", 1), moved("m", "e", Vec3(0, 0, 2)), part("x", kind, other)})),
                ElementsAre(problem("/nodes/x/by", "OriginMismatch", "(0, 0, 2)")));
  }
}

TEST(Erosion, ThatCutsThroughIsAProblemOrAWarning) {
  SceneSpec scene = scene_of({ball("d", 3), ellipsoid("t", 1, 1, 3.2),
                              part("x", "erosion", {{"of", ref("d")}, {"by", ref("t")}, {"n", 1.0}})});
  EXPECT_THAT(problems_of(scene), ElementsAre(problem("/nodes/x/by", "ErosionOverreach", "1.067 times")));
  scene.strict = false;
  const Scene built = build_scene(scene);
  EXPECT_THAT(built.warnings, ElementsAre(problem("/nodes/x/by", "ErosionOverreach", "cut through")));
  EXPECT_EQ(built.field.value(Vec3(0, 0, 0.5)), std::numeric_limits<double>::infinity());
  SceneSpec whole = scene_of({ball("d", 3), ellipsoid("t", 1, 1, 2.999),
                              part("x", "erosion", {{"of", ref("d")}, {"by", ref("t")}, {"n", 1.0}})});
  EXPECT_THAT(problems_of(whole), IsEmpty());
}

TEST(RayScaling, NeedsABoundedT) {
  const NodeSpec slab = part("s", "slab", {{"normal", std::vector<double>{0, 0, 1}}, {"a", 1.0}});
  EXPECT_THAT(
      problems_of(scene_of(
          {ball("d", 3), slab, part("x", "ray_scaling", {{"of", ref("d")}, {"by", ref("s")}, {"n", 1.0}})})),
      ElementsAre(problem("/nodes/x/by", "InvalidParameter", "finite radius in every direction")));
}

TEST(RayScaling, ScalesRadii) {  // R = R_d/R_T^n
  for (const double n : {-2.0, -1.0, 0.0, 1.0, 2.5}) {
    const Scene scene =
        build_scene(scene_of({ball("d", 3), ellipsoid("t", 1.5, 1, 0.5),
                              part("x", "ray_scaling", {{"of", ref("d")}, {"by", ref("t")}, {"n", n}})}));
    EXPECT_TRUE(scene.ray_linear);
    const double radii[] = {1.5, 1.0, 0.5};
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(scene.field.value(2.0 * Vec3::Unit(i)), 2.0 / 3.0 * std::pow(radii[i], n), 1e-14) << n;
    EXPECT_EQ(scene.field.value(Vec3::Zero()), 0.0);
  }
}

TEST(RayScaling, WorksAboutThePlaceOfItsOperands) {
  const Vec3 place(4, -2, 7);
  const Scene scene = build_scene(
      scene_of({ball("b", 3), ellipsoid("e", 1.5, 1, 0.5), moved("d", "b", place), moved("t", "e", place),
                part("x", "ray_scaling", {{"of", ref("d")}, {"by", ref("t")}, {"n", 2.0}})}));
  EXPECT_NEAR(scene.field.value(place + Vec3(0, 0, 2)), 2.0 / 3.0 * 0.25, 1e-14);
  EXPECT_EQ(scene.field.value(place), 0.0);
  ASSERT_TRUE(scene.field.bounds());
  EXPECT_TRUE(scene.field.bounds()->contains(place + Vec3(0, 0, 11.9)));  // R = 3/0.25
}

TEST(OperationNode, IsRayLinearWhenOperatorAndOperandsAre) {
  const auto linear = [](const char* kind, Values values, const Vec3& place) {
    values["of"] = refs({"d", "m"});
    return build_scene(
               scene_of({ball("d", 3), ball("e", 1), moved("m", "e", place), part("x", kind, values)}))
        .ray_linear;
  };
  const Values radii{{"r1", 0.5}, {"r2", 0.5}};
  EXPECT_TRUE(linear("min", {}, Vec3::Zero()));
  EXPECT_TRUE(linear("scale_union_one", radii, Vec3::Zero()));
  EXPECT_TRUE(linear("ricci_intersection_one", {{"n", 2.0}}, Vec3::Zero()));
  EXPECT_FALSE(linear("min", {}, Vec3(1, 0, 0)));
  EXPECT_FALSE(linear("scale_difference_one", radii, Vec3::Zero()));
  EXPECT_FALSE(linear("ricci_difference_one", {{"n", 2.0}}, Vec3::Zero()));
}

// ---- Bounds
// ------------------------------------------------------------------------------------------------

struct Operands {
  std::vector<NodeSpec> nodes;
  std::vector<std::string> names;
};
Operands random_operands(Rng& rng, Level level) {
  Operands all;
  for (int k = integer(rng, 2, 4); k > 0; --k) {
    std::string name = "n" + std::to_string(k);
    all.nodes.push_back(ellipsoid(name, uniform(rng, 0.5, 2), uniform(rng, 0.5, 2), uniform(rng, 0.5, 2)));
    const Vec3 place(uniform(rng, -1.5, 1.5), uniform(rng, -1.5, 1.5), uniform(rng, -1.5, 1.5));
    all.nodes.push_back(moved(name + "m", name, place));
    name += "m";
    if (level == Level::half) all.nodes.push_back(soft(name + "s", name));
    if (level == Level::zero) all.nodes.push_back(part(name + "s", "zero_level", {{"of", ref(name)}}));
    all.names.push_back(level == Level::one ? name : name + "s");
  }
  return all;
}
SceneSpec random_operation(Rng& rng, detail::OperatorId id, Level level) {
  Operands operands = random_operands(rng, level);
  const detail::Operator& row = detail::operator_row(id);
  const detail::OperatorValues v = random_values(rng, id);
  Values values{{"of", refs(operands.names)}};
  if (row.params == detail::OperatorParams::exponent) values["n"] = v.n;
  if (row.params == detail::OperatorParams::radii) {
    values["r1"] = v.r1;
    values["r2"] = v.r2;
    values["p"] = v.p;
  }
  operands.nodes.push_back(part("x", std::string(row.name), values));
  return scene_of(operands.nodes);
}

/// Points of the solid in [-8, 8]^3, most of them looked for next to where solids are.
std::vector<Vec3> points_inside(Rng& rng, const ScalarField& field) {
  std::vector<Vec3> points, inside_points;
  for (int i = 0; i < 4000; ++i) {
    const double reach = i % 2 == 0 ? 8.0 : 3.0;
    points.emplace_back(uniform(rng, -reach, reach), uniform(rng, -reach, reach),
                        uniform(rng, -reach, reach));
  }
  const FieldValues values = field.evaluate(Order::value, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (inside(field.level(), values.value(i)) >= 0.0) inside_points.push_back(points[i]);
  return inside_points;
}

TEST(OperationNode, KnowsBoundsAroundItsSolid) {
  std::size_t found = 0, bounded_scenes = 0, cut = 0;
  for (const detail::OperatorId id : all_operators())
    for_all(
        [&](Rng& rng) {
          const Level any = std::array{Level::one, Level::half, Level::zero}[rng.next() % 3];
          const Level level = detail::operator_row(id).level.value_or(any);
          const Scene scene = build_scene(random_operation(rng, id, level));
          ASSERT_TRUE(scene.field.bounds()) << detail::operator_row(id).name;
          ++bounded_scenes;
          const Box& box = *scene.field.bounds();
          const Box smaller{box.lo + 0.3 * box.size(), box.hi - 0.3 * box.size()};
          for (const Vec3& p : points_inside(rng, scene.field)) {
            ++found;
            if (!smaller.contains(p)) ++cut;
            ASSERT_TRUE(box.contains(p)) << detail::operator_row(id).name << " at " << p.transpose();
          }
        },
        10);
  EXPECT_EQ(bounded_scenes, static_cast<std::size_t>(bounded(10)) * detail::operator_count);
  EXPECT_GT(found, 10000u);
  EXPECT_GT(cut, 500u);  // a box that is too small would have been noticed
}

TEST(DistanceOperation, KnowsBoundsAroundItsSolid) {
  std::size_t found = 0, cut = 0;
  for (const char* kind : {"dilation", "erosion", "ray_scaling"})
    for_all(
        [&](Rng& rng) {
          SceneSpec scene = scene_of(
              {ellipsoid("d", uniform(rng, 1, 3), uniform(rng, 1, 3), uniform(rng, 1, 3),
                         uniform(rng, 0.8, 5)),
               ellipsoid("t", uniform(rng, 0.4, 0.9), uniform(rng, 0.4, 0.9), uniform(rng, 0.4, 0.9),
                         uniform(rng, 1, 5)),
               part("x", kind, {{"of", ref("d")}, {"by", ref("t")}, {"n", uniform(rng, 0.7, 3.0)}})});
          scene.strict = false;
          const Scene built = build_scene(scene);
          ASSERT_TRUE(built.field.bounds());
          const Box& box = *built.field.bounds();
          const Box smaller{0.4 * box.lo, 0.4 * box.hi};
          for (const Vec3& p : points_inside(rng, built.field)) {
            ++found;
            if (!smaller.contains(p)) ++cut;
            ASSERT_TRUE(box.contains(p)) << kind;
          }
        },
        20);
  EXPECT_GT(found, 1000u);
  EXPECT_GT(cut, 100u);
}

TEST(DistanceOperation, PassesTheSuiteInScenes) {
  for (const char* kind : {"dilation", "erosion", "ray_scaling"})
    for_all(
        [&](Rng& rng) {
          const Vec3 place(uniform(rng, -0.5, 0.5), uniform(rng, -0.5, 0.5), uniform(rng, -0.5, 0.5));
          SceneSpec scene = scene_of(
              {ellipsoid("a", uniform(rng, 1.5, 3), uniform(rng, 1.5, 3), uniform(rng, 1.5, 3)),
               moved("d", "a", place),
               ellipsoid("b", uniform(rng, 0.4, 0.9), uniform(rng, 0.4, 0.9), uniform(rng, 0.4, 0.9), 3.0),
               moved("t", "b", place),
               part("y", kind,
                    {{"of", ref("d")},
                     {"by", ref("t")},
                     {"n", *kind == 'r' ? uniform(rng, -2.0, 2.0) : uniform(rng, 0.7, 3.0)}}),
               soft("x", "y")});
          scene.strict = false;
          EXPECT_EQ(evaluator_faults(build_scene(scene).field,
                                     {.points = 100, .boxes = 40, .seed = rng.next(), .useless_share = 0.3}),
                    no_faults)
              << kind;
        },
        12);
}

// ---- Directions
// ----------------------------------------------------------------------------------------------

/// A finished field as a node: one operation that asks its tape.
Node node_of(const SceneSpec& scene) {
  struct Asking {
    std::shared_ptr<const Tape> tape;
  };
  static const Kernel kernel = [](const void* body, const KernelInput& in, double* out) {
    static_cast<const Asking*>(body)->tape->evaluate(
        Order::value, {{in.x, in.count}, {in.y, in.count}, {in.z, in.count}}, {out, in.count});
  };
  static const Op op{"asking",
                     {{kernel, kernel, kernel}},
                     {{kernel, kernel, kernel}},
                     [](const void* body, const Box& box, std::span<const Range>) {
                       return static_cast<const Asking*>(body)->tape->range(box);
                     }};
  Node node;
  node.distance = node.ray_linear = node.positive = true;
  node.emit = [asking = std::make_shared<const Asking>(Asking{build_tape(scene)})](
                  TapeBuilder& builder, const Frame& frame) { return builder.add(op, asking, frame, {}); };
  return node;
}

TEST(DirectionScan, FindsTheExtremesOfARatio) {
  for_all(
      [](Rng& rng) {
        const Vec3 a(uniform(rng, 1, 3), uniform(rng, 1, 3), uniform(rng, 1, 3));
        const Node d = node_of(scene_of({ellipsoid("x", a[0], a[1], a[2])})),
                   one = node_of(scene_of({ball("x", 1)}));
        const detail::RatioScan scan = detail::scan_ratio(one, d);  // the radius of d = 1
        // extremes of a quadratic form, found by a walk that ends at steps of 1e-7
        EXPECT_NEAR(scan.min, a.minCoeff(), 1e-9);
        EXPECT_NEAR(scan.max, a.maxCoeff(), 1e-9);
        const Vec3 along = scan.max_direction.cwiseAbs();
        int longest = 0;
        a.maxCoeff(&longest);
        EXPECT_GT(along[longest], 0.9);
      },
      20);
}

TEST(DirectionScan, BoundsRadiiTightly) {
  for_all(
      [](Rng& rng) {
        const Vec3 a(uniform(rng, 1, 3), uniform(rng, 1, 3), uniform(rng, 1, 3));
        const double n = uniform(rng, 0.6, 8.0);
        const Node d = node_of(scene_of({ellipsoid("x", a[0], a[1], a[2], n)}));
        const detail::RatioScan scan = detail::scan_ratio(node_of(scene_of({ball("x", 1)})), d);
        const Range bounds = detail::radius_bounds(d);
        EXPECT_LE(bounds.lo, scan.min);
        EXPECT_GE(bounds.hi, scan.max);
        // pieces of a few degrees: radii change by less than a tenth across them
        EXPECT_GE(bounds.lo, 0.9 * scan.min);
        EXPECT_LE(bounds.hi, 1.1 * scan.max);
      },
      20);
}

TEST(DirectionScan, KnowsNoRadiusWhereADistanceVanishes) {
  const Node slab =
      node_of(scene_of({part("s", "slab", {{"normal", std::vector<double>{0.0, 0.6, 0.8}}, {"a", 1.0}})}));
  EXPECT_EQ(detail::radius_bounds(slab).hi, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace blendwright::test
