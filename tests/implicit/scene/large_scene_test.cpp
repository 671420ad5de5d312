// Scenes that are long, deep or used many times over.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "implicit/scene/scene.hpp"
#include "kernel/base/error.hpp"
#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright::test {
namespace {

/// Processor time of this thread, in seconds.
template <class F>
double seconds(F f) {
  const std::clock_t start = std::clock();
  f();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

std::string n(int i) { return "n" + std::to_string(i); }

double value_at(const Scene& scene, const Vec3& p) { return scene.field.value(p); }

TEST(LongChain, OfComplementsBuildsAndEndsWhereItBegan) {
  constexpr int length = 100'000;
  std::vector<NodeSpec> nodes = {ball("ball", 2.0), soft("n0", "ball")};
  for (int i = 1; i <= length; ++i) nodes.push_back(part(n(i), "complement", {{"of", ref(n(i - 1))}}));
  std::reverse(nodes.begin(), nodes.end());  // users first
  SceneSpec spec = scene_of(std::move(nodes));
  spec.solid = n(length);
  const Scene scene = build_scene(spec);
  EXPECT_EQ(scene.nodes, static_cast<std::size_t>(length) + 2);
  // 1 - f is exact for f in [1/2, 1], and for every f after the first time.
  EXPECT_EQ(value_at(scene, Vec3(0.7, 0, 0)),
            value_at(build_scene(scene_of({ball("b", 2.0), soft("s", "b")})), Vec3(0.7, 0, 0)));
}

TEST(LongChain, OfUnionsKeepsItsBounds) {
  constexpr int length = 20'000;
  std::vector<NodeSpec> nodes = {ball("ball", 2.0), soft("n0", "ball")};
  for (int i = 1; i <= length; ++i) {
    nodes.push_back(part("p" + std::to_string(i), "place",
                         {{"of", ref("n0")}, {"move", std::vector<double>{static_cast<double>(i), 0, 0}}}));
    nodes.push_back(part(n(i), "max", {{"of", refs({n(i - 1), "p" + std::to_string(i)})}}));
  }
  const Scene scene = build_scene(scene_of(std::move(nodes)));
  ASSERT_TRUE(scene.field.bounds());
  EXPECT_NEAR(scene.field.bounds()->lo.x(), -1.0, 1e-9);
  EXPECT_NEAR(scene.field.bounds()->hi.x(), length + 1.0, 1e-9 * length);
  EXPECT_NEAR(scene.field.bounds()->hi.y(), 1.0, 1e-9);
}

TEST(LargeScene, OfAHundredThousandNodesTakesLessThanASecond) {
  constexpr int count = 50'000;  // two nodes each
  std::vector<NodeSpec> nodes;
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) {
    nodes.push_back(ball("b" + std::to_string(i), 1.0 + i % 7));
    nodes.push_back(soft(n(i), "b" + std::to_string(i)));
    names.push_back(n(i));
  }
  nodes.push_back(part("all", "soft_blend", {{"of", refs(names)}}));
  const SceneSpec spec = scene_of(std::move(nodes));
  double time = std::numeric_limits<double>::infinity();  // the best of three: others use the machine, too
  for (int run = 0; run < 3; ++run)
    time = std::min(time, seconds([&] {
                      const Scene scene = build_scene(spec);
                      EXPECT_EQ(scene.field.members().size(), static_cast<std::size_t>(count));
                      EXPECT_LE(scene.steps, 3u * count);
                    }));
  RecordProperty("seconds", std::to_string(time));
#ifdef NDEBUG
  EXPECT_LT(time, 1.0);
#endif
}

// max(a, a) of max(a, a) ...: 2^200 paths, 200 steps.
TEST(SharedNodes, AreComputedOnce) {
  std::vector<NodeSpec> nodes = {ball("ball", 2.0), soft("n0", "ball")};
  for (int i = 1; i <= 200; ++i)
    nodes.push_back(part(n(i), "soft_blend", {{"of", refs({n(i - 1), n(i - 1)})}}));
  const Scene scene = build_scene(scene_of(std::move(nodes)));
  EXPECT_EQ(scene.steps, 1u + 200u);  // a soft ball is one step
  EXPECT_EQ(scene.field.members(), std::vector<std::string>{"n0"});
}

// The same with a placement at every level: every path is another place.
TEST(SharedNodes, InTooManyPlacesAreRefused) {
  std::vector<NodeSpec> nodes = {ball("ball", 2.0), soft("n0", "ball")};
  for (int i = 1; i <= 30; ++i) {
    nodes.push_back(part("p" + std::to_string(i), "place",
                         {{"of", ref(n(i - 1))}, {"move", std::vector<double>{std::ldexp(1.0, i), 0, 0}}}));
    nodes.push_back(part(n(i), "max", {{"of", refs({n(i - 1), "p" + std::to_string(i)})}}));
  }
  const std::vector<Problem> problems = problems_of(scene_of(std::move(nodes)));
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems.at(0).where, "/nodes/n30");
  EXPECT_THAT(problems.at(0).message, testing::HasSubstr("more than 1000000 nodes"));
}

TEST(SharedNodes, InAThousandPlacesAreNot) {
  std::vector<NodeSpec> nodes = {ball("ball", 2.0), soft("n0", "ball")};
  for (int i = 1; i <= 10; ++i) {
    nodes.push_back(part("p" + std::to_string(i), "place",
                         {{"of", ref(n(i - 1))}, {"move", std::vector<double>{std::ldexp(1.0, i), 0, 0}}}));
    nodes.push_back(part(n(i), "max", {{"of", refs({n(i - 1), "p" + std::to_string(i)})}}));
  }
  EXPECT_EQ(build_tape(scene_of(std::move(nodes)))->size(), 1024u + 1023u);
}

TEST(Placements, ThatShrinkEachOtherToNothingAreRefused) {
  std::vector<NodeSpec> nodes = {ball("ball", 2.0), soft("n0", "ball")};
  for (int i = 1; i <= 2'000; ++i)
    nodes.push_back(part(n(i), "place", {{"of", ref(n(i - 1))}, {"scale", 2.0}}));
  const std::vector<Problem> problems = problems_of(scene_of(std::move(nodes)));
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems.at(0).where, "/nodes/n2000");
  EXPECT_THAT(problems.at(0).message, testing::HasSubstr("leave the range of numbers"));
}

TEST(DistanceOperations, AreNotNestedWithoutEnd) {
  for (const int depth : {64, 65}) {
    std::vector<NodeSpec> nodes = {ball("ball", 0.5), ball("n0", 2.0)};
    for (int i = 1; i <= depth; ++i)
      nodes.push_back(part(n(i), "dilation", {{"of", ref(n(i - 1))}, {"by", ref("ball")}, {"n", 1.0}}));
    const SceneSpec spec = scene_of(std::move(nodes));
    if (depth == 64)
      EXPECT_EQ(build_tape(spec)->size(), 66u);
    else
      EXPECT_EQ(problems_of(spec).at(0).where, "/nodes/n65");
  }
}

TEST(LongCycle, IsNamedByItsFirstNodes) {
  constexpr int length = 100'000;
  std::vector<NodeSpec> nodes;
  for (int i = 0; i < length; ++i)
    nodes.push_back(part(n(i), "complement", {{"of", ref(n((i + 1) % length))}}));
  const std::vector<Problem> problems = problems_of(scene_of(std::move(nodes)));
  ASSERT_FALSE(problems.empty());
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].where, "/nodes/n0/of");
  EXPECT_THAT(problems[0].message, testing::HasSubstr("n0 -> n1 -> n2 -> "));
  EXPECT_THAT(problems[0].message, testing::HasSubstr("... (100000 nodes) -> n0"));
}

// Two cycles, each with users that hang on it and are not to blame.
TEST(Cycles, AreAllReported) {
  const auto turn = [](std::string name, std::string of) {
    return part(std::move(name), "complement", {{"of", ref(std::move(of))}});
  };
  const std::vector<Problem> problems =
      problems_of(scene_of({turn("x", "b"), turn("a", "b"), turn("b", "c"), turn("c", "a"), turn("p", "q"),
                            turn("q", "p"), turn("y", "x")}));
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_THAT(problems[0].message, testing::HasSubstr("a -> b -> c -> a"));
  EXPECT_THAT(problems[1].message, testing::HasSubstr("p -> q -> p"));
}

TEST(ManyFaults, DoNotTakeLong) {
  constexpr int count = 100'000;
  std::vector<NodeSpec> nodes;
  for (int i = 0; i < count; ++i)
    nodes.push_back(part(n(i), "complement", {{"of", ref("m" + std::to_string(i))}}));
  const SceneSpec spec = scene_of(std::move(nodes));
  EXPECT_LT(seconds([&] { EXPECT_EQ(problems_of(spec).size(), static_cast<std::size_t>(count)); }), 5.0);
}

}  // namespace
}  // namespace blendwright::test
