// Broken operators of level function: each is one change away from a scene that builds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright::test {
namespace {

using Numbers = std::vector<double>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

/// A node of every shape of parameters.
SceneSpec sound() {
  const NodeValue two = refs({"a", "b"}), three = refs({"a", "b", "c"});
  return scene_of({
      part("a", "sphere", {{"radius", 1.0}}),
      part("b", "box", {{"half", Numbers{1, 1, 1}}}),
      part("c", "ellipsoid_quadric", {{"a", 1.0}, {"b", 2.0}, {"c", 1.5}}),
      ball("d", 1.0),
      soft("soft", "d"),
      part("zero", "zero_level", {{"of", ref("d")}}),
      part("r", "r_union", {{"of", three}, {"alpha", 0.3}}),
      part("m", "r0m_intersection", {{"of", two}, {"m", 2.0}}),
      part("ricci", "ricci_difference_function", {{"of", three}, {"n", 4.0}}),
      part("liming", "liming", {{"of", two}, {"blend", ref("c")}, {"u", 0.4}, {"order", 3.0}}),
      part("clipped", "liming_clipped", {{"of", two}, {"c_a", 1.0}, {"c_b", 2.0}, {"r", 0.5}, {"u", 0.4}}),
      part("rock", "rockwood_union", {{"of", three}, {"r", Numbers{0.2, 0.3, 0.4}}, {"w", 2.0}}),
      part("raw", "rockwood_raw", {{"of", two}, {"r", Numbers{0.2}}, {"w", 2.0}}),
      part("edge", "pasko_savchenko_union", {{"of", two}, {"a", Numbers{0.2, 0.3, 0.4}}}),
      part("bounded", "bounded_blend_union",
           {{"of", two}, {"within", ref("c")}, {"a", Numbers{0.2, 0.3, 0.4, 0.5}}}),
      part("local", "local_blend",
           {{"of", two}, {"r", Numbers{0.2, 0.3}}, {"around", ref("c")}, {"fade", 0.1}}),
      part("all", "r_union",
           {{"of",
             refs({"r", "m", "ricci", "liming", "clipped", "rock", "raw", "edge", "bounded", "local"})}}),
  });
}

struct Broken {
  std::string node, key;
  NodeValue value;
  std::string below, words;
};
const std::vector<Broken>& broken() {
  static const std::vector<Broken> all{
      {"r", "alpha", -1.0, "", "InvalidParameter: is -1, must be > -1 and <= 1"},
      {"r", "alpha", 1.5, "", "InvalidParameter: is 1.5, must be > -1 and <= 1"},
      {"r", "alpha", nan, "", "is nan, must be"},
      {"r", "of", refs({"a"}), "", "is a list of 1 node, must be a list of at least 2 nodes"},
      {"r", "of", refs({"a", "soft"}), "/1",
       "LevelMismatch: is of half level, must be of function representation: put it into a node of kind "
       "\"convert\""},
      {"r", "of", refs({"zero", "b"}), "/0", "LevelMismatch: is of zero level"},
      {"ricci", "of", refs({"a", "b", "d"}), "/2", "LevelMismatch: is of one level"},
      {"r", "m", 2.0, "", "unknown key; may be \"of\" or \"alpha\""},
      {"m", "m", 0.0, "", "must be a whole number >= 1 and <= 16"},
      {"m", "m", 1.5, "", "must be a whole number"},
      {"m", "m", 17.0, "", "must be a whole number >= 1 and <= 16"},
      {"ricci", "n", 0.0, "", "is 0, must be >="},
      {"ricci", "n", inf, "", "is inf, must be"},
      {"liming", "u", 0.0, "", "is 0, must be >= 1e-06 and <= 0.999999"},
      {"liming", "u", 1.0, "", "is 1, must be >= 1e-06 and <= 0.999999"},
      {"liming", "u", -0.2, "", "is -0.2, must be >= 1e-06"},
      {"liming", "of", refs({"a", "b", "c"}), "", "is a list of 3 nodes, must be a list of 2"},
      {"liming", "blend", ref("d"), "", "LevelMismatch: is of one level"},
      {"liming", "order", 0.0, "", "must be a whole number >= 1"},
      {"liming", "through", Numbers{0, 0, 0}, "", "is given together with u, must be given instead of it"},
      {"clipped", "u", 1.0, "", "is 1, must be >= 1e-06 and <= 0.999999"},
      {"clipped", "c_a", -1.0, "", "is -1, must be > 0"},
      {"clipped", "r", 0.0, "", "is 0, must be > 0"},
      {"clipped", "join", std::string("unite"), "", "must be \"union\", \"intersection\" or \"difference\""},
      {"clipped", "of", refs({"a", "b", "c"}), "", "is a list of 3 nodes, must be a list of 2"},
      {"rock", "r", Numbers{0.2, 0.3}, "",
       "is a list of 2 numbers, must be one number for each of the 3 operands, or one for all"},
      {"rock", "r", Numbers{}, "", "is a list of 0 numbers, must be a list of at least one number"},
      {"rock", "r", Numbers{0.2, 0.0, 0.4}, "/1", "InvalidParameter: is 0, must be > 0"},
      {"rock", "r", Numbers{0.2, nan, 0.4}, "/1", "is nan, must be a finite number"},
      {"rock", "r", 0.2, "", "is 0.2, must be a list of at least one number"},
      {"rock", "w", 0.9, "", "is 0.9, must be >= 1"},
      {"raw", "w", 1e5, "", "must be >= 1 and <= 10000"},
      {"raw", "r", Numbers{0.2, -0.3}, "/1", "is -0.3, must be > 0"},
      {"edge", "a", Numbers{0.2, 0.3}, "", "is a list of 2 numbers, must be a list of 3 numbers"},
      {"edge", "a", Numbers{0.2, 0.0, 0.3}, "/1", "is 0, must be > 0"},
      {"edge", "a", Numbers{1e40, 0.1, 0.3}, "/0", "must be at most 1e+30 in magnitude"},
      {"edge", "of", refs({"a", "b", "c"}), "", "must be a list of 2"},
      {"bounded", "a", Numbers{0.2, 0.3, 0.3, -0.3}, "/3", "is -0.3, must be > 0"},
      {"bounded", "within", ref("soft"), "", "LevelMismatch: is of half level"},
      {"bounded", "within", 3.0, "", "is 3, must be a node"},
      {"bounded", "withn", ref("c"), "", "did you mean \"within\"?"},
      {"local", "around", ref("zero"), "", "LevelMismatch: is of zero level"},
      {"local", "fade", 0.0, "", "is 0, must be > 0"},
      {"local", "r", Numbers{0.2, 0.3, 0.4}, "", "must be one number for each of the 2 operands"},
  };
  return all;
}

TEST(BrokenFunctions, AreRefusedAtTheChangedPlace) {
  ASSERT_TRUE(problems_of(sound()).empty()) << problems_of(sound()).front().message;
  for (const Broken& b : broken()) {
    SCOPED_TRACE(b.node + " " + b.key + " " + b.words);
    SceneSpec scene = sound();
    find(scene, b.node)->values[b.key] = b.value;
    const std::vector<Problem> problems = problems_of(scene);
    ASSERT_FALSE(problems.empty());
    EXPECT_EQ(problems.front().where, "/nodes/" + b.node + "/" + b.key + b.below);
    EXPECT_THAT(problems.front().message, testing::HasSubstr(b.words));
    EXPECT_EQ(problems.size(), 1u);
    if (std::getenv("BLENDWRIGHT_SHOW_MESSAGES"))
      for (const Problem& p : problems) std::printf("%s: %s\n", p.where.c_str(), p.message.c_str());
  }
  EXPECT_GE(broken().size(), 25u);
}

TEST(BrokenFunctions, ThatLackAValueAreRefused) {
  for (const auto& [node, key] : std::vector<std::pair<std::string, std::string>>{{"m", "m"},
                                                                                  {"ricci", "n"},
                                                                                  {"liming", "blend"},
                                                                                  {"clipped", "c_a"},
                                                                                  {"rock", "r"},
                                                                                  {"edge", "a"},
                                                                                  {"bounded", "within"},
                                                                                  {"local", "around"},
                                                                                  {"local", "fade"},
                                                                                  {"r", "of"}}) {
    SceneSpec scene = sound();
    find(scene, node)->values.erase(key);
    const std::vector<Problem> problems = problems_of(scene);
    ASSERT_EQ(problems.size(), 1u) << node << " " << key;
    EXPECT_EQ(problems.front().where, "/nodes/" + node + "/" + key);
    EXPECT_THAT(problems.front().message, testing::StartsWith("is missing, must be"));
  }
}

/// A curve through a point where A B or P^(n+1) is not positive would need u outside (0, 1).
TEST(BrokenFunctions, NoBlendGoesThroughAPointOnTheWrongSide) {
  SceneSpec scene = sound();
  NodeSpec& liming = *find(scene, "liming");
  liming.values.erase("u");
  liming.values["through"] = Numbers{5, 0, 0};
  EXPECT_TRUE(problems_of(scene).empty());  // both outside: A B > 0, and n + 1 even
  liming.values["through"] = Numbers{0, 0, 1.2};
  find(scene, "b")->values["half"] = Numbers{1, 1, 2};
  const std::vector<Problem> problems = problems_of(scene);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems.front().where, "/nodes/liming/through");
  EXPECT_THAT(problems.front().message, testing::HasSubstr("must have both > 0"));
}

TEST(BrokenFunctions, WarnOfMaterialThatIsNothing) {
  SceneSpec scene = sound();
  find(scene, "edge")->values["a"] = Numbers{0.0, 1.0, 1.0};
  bool warned = false;
  for (const Problem& w : build_scene(scene).warnings) warned = warned || w.where == "/nodes/edge/a";
  EXPECT_TRUE(warned);
}

}  // namespace
}  // namespace blendwright::test
