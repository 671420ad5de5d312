// Conversions between all levels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "implicit/scene/scene.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"
#include "tests/implicit/support/scene_parts.hpp"
#include "tests/support/golden_folder.hpp"
#include "tests/support/relation_golden.hpp"

namespace blendwright::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using List = std::vector<double>;

const std::vector<std::pair<Level, std::string>> levels{
    {Level::zero, "zero"}, {Level::one, "one"}, {Level::half, "half"}, {Level::function, "function"}};

NodeSpec convert(const std::string& of, const std::string& to, const std::string& adapter = "linear") {
  return part("case", "convert", {{"of", ref(of)}, {"to", to}, {"adapter", adapter}});
}
/// The function x, of level function.
NodeSpec slope(const std::string& name) {
  return part(name, "quadric", {{"coefficients", List{0, 0, 0, 0, 0, 0, 1, 0, 0, 0}}});
}
/// A node of a level whose value at (x, 0, 0) is x + the surface value, or its negative: sense * phi = x.
std::vector<NodeSpec> of_level(const std::string& to) {
  NodeSpec node = convert("slope", to);
  node.name = "native";
  std::vector<NodeSpec> nodes{slope("slope")};
  if (to == "function")
    nodes.back().name = "native";
  else
    nodes.push_back(std::move(node));
  return nodes;
}

/// phi of a native value in the four conventions.
TEST(Convert, ReachesTheGoldenValues) {
  std::size_t seen = 0;
  for (const RelationCase& c : read_relation_golden(golden_folder())) {
    if (c.function != "level_conversion") continue;
    for (const RelationSample& s : c.samples) {
      const double n = s.numbers.at("native");
      const std::map<std::string, double> phi{{"function", s.numbers.at("frep")},
                                              {"zero", s.numbers.at("zero_level")},
                                              {"one", s.numbers.at("constructive")},
                                              {"half", s.numbers.at("half_level")}};
      for (const auto& [level, name] : levels) {
        const double golden = phi.at(name), size = std::max(1.0, std::abs(golden));
        EXPECT_NEAR(inside(level, n), golden, 1e-12 * size);
        // A node of that level with the value n at (golden, 0, 0), turned back into a function.
        std::vector<NodeSpec> nodes = of_level(name);
        const Vec3 at(golden, 0, 0);
        EXPECT_NEAR(build_scene(scene_of(nodes)).field.value(at), n, 1e-12 * size) << name;
        nodes.push_back(convert("native", "function"));
        EXPECT_NEAR(build_scene(scene_of(nodes)).field.value(at), golden, 1e-12 * size) << name;
        ++seen;
      }
    }
  }
  EXPECT_EQ(seen, 32u);
}

TEST(Convert, KeepsTheSolidBetweenAllLevels) {
  for (const auto& [from, from_name] : levels)
    for (const auto& [to, to_name] : levels) {
      SCOPED_TRACE(from_name + " to " + to_name);
      std::vector<NodeSpec> nodes = of_level(from_name);
      nodes.push_back(convert("native", to_name));
      const Scene scene = build_scene(scene_of(nodes));
      EXPECT_EQ(scene.field.level(), to);
      EXPECT_EQ(scene.warnings.empty(), from != to);
      for (const double x : {-2.0, -0.5, -1e-9, 0.0, 1e-9, 0.25, 3.0})
        EXPECT_NEAR(inside(to, scene.field.value({x, 0, 0})), x, 1e-15 * 8.0);  // sums of numbers below 4
    }
}

TEST(Convert, ObeysTheLawsOfEvaluation) {
  for (const char* adapter : {"linear", "exponential"}) {
    const auto tape = build_tape(
        scene_of({part("solid", "torus", {{"ring", 1.2}, {"tube", 0.5}}), convert("solid", "one", adapter)}));
    EXPECT_EQ(evaluator_faults(*tape), no_faults) << adapter;
  }
}

/// n = exp(-phi) is positive everywhere and has the same zero set; its region follows.
TEST(Convert, ExponentiallyIsPositiveEverywhere) {
  const Scene scene = build_scene(
      scene_of({part("solid", "sphere", {{"radius", 5.0}}), convert("solid", "one", "exponential")}));
  EXPECT_NEAR(scene.field.value({0, 0, 0}), std::exp(-5.0), 1e-15);
  EXPECT_NEAR(scene.field.value({5, 0, 0}), 1.0, 1e-14);
  EXPECT_NEAR(scene.field.value({0, 7, 0}), std::exp(2.0), 1e-13);
  EXPECT_TRUE(std::isinf(scene.field.value({1e6, 0, 0})));
  ASSERT_TRUE(scene.field.bounds());
  EXPECT_NEAR(scene.field.bounds()->hi.y(), 5.0, 1e-9);
}

TEST(Convert, KeepsBounds) {
  for (const auto& [to, to_name] : levels) {
    const Scene scene =
        build_scene(scene_of({part("solid", "box", {{"half", List{1, 2, 3}}}), convert("solid", to_name)}));
    ASSERT_TRUE(scene.field.bounds()) << to_name;
    EXPECT_NEAR((scene.field.bounds()->hi - Vec3(1, 2, 3)).norm(), 0.0, 1e-9);
  }
}

/// Operators that need positive arguments take what the exponential adapter gives and refuse what a sum
/// gives.
TEST(Convert, DoesNotSmuggleSignedFieldsIntoPowers) {
  const auto scene = [](const std::string& adapter) {
    NodeSpec a = convert("a0", "one", adapter), b = convert("b0", "one", adapter);
    a.name = "a";
    b.name = "b";
    return scene_of({part("a0", "sphere", {{"radius", 1.0}}), part("b0", "box", {{"half", List{1, 1, 1}}}), a,
                     b, part("case", "ricci_union_one", {{"of", refs({"a", "b"})}, {"n", 2.0}})});
  };
  EXPECT_THAT(problems_of(scene("exponential")), IsEmpty());
  const auto problems = problems_of(scene("linear"));
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_THAT(problems[0].message, HasSubstr("LevelMismatch"));
}

/// A linear map to level half may leave [0, 1]; sharp operators take that, also through placements, powers
/// not.
TEST(Convert, MarksHalfLevelsBeyondTheirBounds) {
  const auto scene = [](const std::string& operation) {
    NodeSpec a = convert("solid", "half");
    a.name = "a";
    Values values{{"of", refs({"moved", "moved"})}};
    if (operation.starts_with("ricci")) values["n"] = 2.0;
    return scene_of({part("solid", "sphere", {{"radius", 1.0}}), a,
                     part("turned", "complement", {{"of", ref("a")}}),
                     part("moved", "place", {{"of", ref("turned")}, {"move", List{1, 0, 0}}}),
                     part("case", operation, values)});
  };
  EXPECT_THAT(problems_of(scene("max")), IsEmpty());
  const auto problems = problems_of(scene("ricci_union_half"));
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_THAT(problems[0].message, HasSubstr("may leave [0, 1]"));
}

TEST(Convert, IsExponentialToLevelOneOnly) {
  const auto problems = problems_of(scene_of({slope("solid"), convert("solid", "zero", "exponential")}));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].where, "/nodes/case/adapter");
  EXPECT_THAT(problems[0].message, HasSubstr("LevelMismatch: is exponential, must be linear"));
}

}  // namespace
}  // namespace blendwright::test
