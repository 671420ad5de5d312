// Broken scenes: each is one change away from a scene that builds, and each is refused at the changed place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <ostream>

#include "implicit/scene/scene.hpp"
#include "kernel/base/error.hpp"
#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright::test {
namespace {

using Rows = std::vector<std::vector<double>>;
using Numbers = std::vector<double>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

/// Every family, and every type of value, in one scene that builds.
SceneSpec sound() {
  const Rows moved = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-3, 0, 1}};
  return scene_of({
      part("leaf", "rose", {{"k", 6.0}, {"a", 8.0}, {"eps", 0.35}}),
      part("column", "polar_bar", {{"profile", ref("leaf")}, {"c", 24.0}, {"n", 20.0}}),
      part("bar", "superquadric", {{"a", 8.0}, {"b", 8.0}, {"c", 24.0}, {"n1", 1.1}, {"n2", 20.0}}),
      ball("ball", 20.0),
      ball("core", 5.0),
      part("outline", "superquadric", {{"a", 13.0}, {"b", 13.0}, {"c", 30.0}, {"n1", 2.0}, {"n2", 20.0}}),
      part("rod", "segment_skeleton", {{"p0", Numbers{-3, 0, 0}}, {"p1", Numbers{4, 0, 0}}, {"radius", 5.0}}),
      part("stone", "generalized_distance", {{"normals", Rows{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {"n", 8.0}}),
      part("egg", "asymmetric_superellipsoid",
           {{"x", Numbers{5, 5}}, {"y", Numbers{5, 5}}, {"z", Numbers{18, 6}}, {"n", 2.0}}),
      part("wall", "slab", {{"normal", Numbers{0, 0, 1}}, {"a", 2.0}}),
      part("rail", "plane", {{"normal", Numbers{0, 0, 1}}, {"a", 2.0}}),
      part("eroded", "erosion", {{"of", ref("ball")}, {"by", ref("core")}, {"n", 1.0}}),
      part("soft ball", "soft_object", {{"distance", ref("ball")}, {"w1", 0.5}, {"w2", 0.5}}),
      part("soft bar", "soft_object",
           {{"distance", ref("bar")},
            {"potential", std::string("blanc")},
            {"softness", 0.5},
            {"w1", ref("outline")},
            {"w2", 1.0}}),
      soft("soft rod", "rod"),
      part("moved", "affine", {{"of", ref("soft ball")}, {"matrix", moved}}),
      part("turned", "place",
           {{"of", ref("soft rod")},
            {"move", Numbers{1, 2, 3}},
            {"axis", Numbers{0, 1, 1}},
            {"turn_deg", 30.0},
            {"scale", 2.0}}),
      part("flat", "zero_level", {{"of", ref("wall")}, {"form", std::string("logarithm")}}),
      part("flat ball", "zero_level", {{"of", ref("ball")}}),
      part("cut", "hoffmann_intersection_zero",
           {{"of", refs({"flat", "flat ball"})}, {"r1", 0.3}, {"r2", 0.3}, {"p", 0.0}}),
      part("wound", "sweep_curve",
           {{"curve", std::vector<std::string>{"3*cos(t)", "3*sin(t)", "t/4"}},
            {"t", Numbers{0, 6}},
            {"profile", ref("leaf")},
            {"cap", 1.0}}),
      part("all", "soft_blend", {{"of", refs({"soft bar", "moved", "turned"})}}),
  });
}

struct Broken {
  std::string id;
  std::function<void(SceneSpec&)> change;
  std::string where;
  std::string words;  ///< the message contains them
};

void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.id; }

/// Another value under a key of a node.
Broken value(std::string id, std::string node, std::string key, NodeValue changed, std::string below,
             std::string words) {
  std::string where = "/nodes/" + node + '/' + key + below;
  return {std::move(id), [=](SceneSpec& s) { find(s, node)->values[key] = changed; }, std::move(where),
          std::move(words)};
}
Broken missing(std::string node, std::string key, std::string words) {
  return {"no-" + key, [=](SceneSpec& s) { find(s, node)->values.erase(key); }, "/nodes/" + node + '/' + key,
          std::move(words)};
}
Broken other(std::string id, std::string where, std::string words, std::function<void(SceneSpec&)> change) {
  return {std::move(id), std::move(change), std::move(where), std::move(words)};
}

std::vector<Broken> broken_values() {
  return {
      value("negative-axis", "ball", "a", -2.0, "", "is -2, must be > 0"),
      value("zero-exponent", "ball", "n", 0.0, "", "is 0, must be >"),
      value("nan-axis", "ball", "b", nan, "", "InvalidParameter: is nan"),
      value("infinite-axis", "ball", "c", inf, "", "InvalidParameter: is inf"),
      value("negative-softness", "soft bar", "softness", -0.5, "", "InvalidParameter: is -0.5, must be >= 0"),
      value("text-for-number", "ball", "a", std::string("wide"), "", "is \"wide\", must be > 0"),
      value("list-for-number", "ball", "a", Numbers{1, 2}, "", "is a list of 2 numbers, must be > 0"),
      value("node-for-number", "ball", "a", ref("core"), "", "is the node \"core\", must be > 0"),
      value("unknown-word", "soft bar", "potential", std::string("blanch"), "", "did you mean \"blanc\"?"),
      value("number-for-word", "soft bar", "potential", 3.0, "", "is 3, must be \"blanc\""),
      value("unknown-key", "soft bar", "sofness", 0.5, "", "did you mean \"softness\"?"),
      value("half-a-lobe", "leaf", "k", 5.5, "", "must be a whole number"),
      value("flat-point", "rod", "p0", Numbers{1, 2}, "", "is a list of 2 numbers, must be a point"),
      value("nan-point", "rod", "p1", Numbers{1, nan, 2}, "/1", "is nan, must be a finite number"),
      value("number-for-node", "soft rod", "distance", 4.0, "", "is 4, must be a node"),
      value("number-for-nodes", "all", "of", 4.0, "", "must be a list of at least"),
      value("no-normals", "stone", "normals", Rows{}, "", "must be a list of at least one point"),
      value("short-normal", "stone", "normals", Rows{{1, 0, 0}, {0, 1}}, "/1", "has 2 numbers, must have 3"),
      value("three-half-axes", "egg", "z", Numbers{1, 2, 3}, "",
            "is a list of 3 numbers, must be a list of 2"),
      value("three-rows", "moved", "matrix", Rows{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, "",
            "4 rows of 3 numbers"),
      value("nan-matrix", "moved", "matrix", Rows{{1, 0, 0}, {0, nan, 0}, {0, 0, 1}, {0, 0, 0}}, "/1/1",
            "is nan"),
      value("singular-matrix", "moved", "matrix", Rows{{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 0}}, "",
            "is singular"),
      value("zero-scale", "turned", "scale", 0.0, "", "is 0, must be >"),
      value("zero-axis", "turned", "axis", Numbers{0, 0, 0}, "", "has length 0"),
      value("two-formulas", "wound", "curve", std::vector<std::string>{"t", "t"}, "",
            "is a list of 2 texts, must be a list of 3 formulas"),
      missing("bar", "n1", "is missing, must be >"),
      missing("rod", "p0", "is missing, must be a point"),
      missing("soft rod", "distance", "is missing, must be a node"),
      missing("moved", "matrix", "is missing, must be 4 rows"),
  };
}

std::vector<Broken> broken_structure() {
  return {
      value("missing-node", "soft rod", "distance", ref("rodd"), "", "did you mean \"rod\"?"),
      value("missing-in-list", "all", "of", refs({"moved", "soft bra"}), "/1", "did you mean \"soft bar\"?"),
      value("missing-contour", "soft bar", "w1", ref("outlin"), "/contour", "did you mean \"outline\"?"),
      value("missing-quite", "soft rod", "distance", ref("xyz"), "",
            "is \"xyz\", must be the name of a node"),
      value("profile-as-distance", "soft rod", "distance", ref("leaf"), "",
            "a rose, must be a node in space"),
      value("distance-as-profile", "column", "profile", ref("ball"), "", "a lp_metric, must be a profile"),
      other("unknown-kind", "/nodes/bar/kind", "did you mean \"superquadric\"?",
            [](SceneSpec& s) { find(s, "bar")->kind = "superquadrik"; }),
      other("unlike-any-kind", "/nodes/bar/kind", "must be a kind of node, as \"list nodes\"",
            [](SceneSpec& s) { find(s, "bar")->kind = "teapot of Utah"; }),
      other("duplicate-name", "/nodes/ball", "has the name \"ball\" of the node at /nodes/ball",
            [](SceneSpec& s) { s.nodes.push_back(ball("ball", 2.0)); }),
      other("no-name", "/nodes/", "has no name", [](SceneSpec& s) { s.nodes.push_back(ball("", 2.0)); }),
      other("own-user", "/nodes/moved/of", "moved -> moved;",
            [](SceneSpec& s) { find(s, "moved")->values["of"] = ref("moved"); }),
      other("cycle", "/nodes/moved/of", "moved -> turned -> moved; must not be a cycle",
            [](SceneSpec& s) {
              find(s, "moved")->values["of"] = ref("turned");
              find(s, "turned")->values["of"] = ref("moved");
            }),
      other("unknown-solid", "/solid", "is \"al\", must be the name of a node",
            [](SceneSpec& s) { s.solid = "al"; }),
      other("no-solid", "/solid", "is \"\"", [](SceneSpec& s) { s.solid.clear(); }),
      other("flat-solid", "/solid", "is \"leaf\", a rose, must be a node in space",
            [](SceneSpec& s) { s.solid = "leaf"; }),
      other("no-nodes", "/nodes", "is empty", [](SceneSpec& s) { s.nodes.clear(); }),
      other("odd-name", "/nodes/a~1b~0c/a", "is 0, must be > 0",
            [](SceneSpec& s) { s.nodes.push_back(ball("a/b~c", 0.0)); }),
      other("inline-node", "/nodes/all/of/0/a", "is 0, must be > 0",
            [](SceneSpec& s) {
              s.nodes.push_back(ball("/nodes/all/of/0", 0.0));
              s.nodes.back().where = "/nodes/all/of/0";
            }),
  };
}

std::vector<Broken> broken_meaning() {
  return {
      value("range-too-wide", "soft ball", "w2", 1.5, "", "InvalidParameter: is 1.5, must be >"),
      value("range-zero", "soft ball", "w1", 0.0, "", "InvalidParameter: is 0, must be >"),
      other("range-hollow", "/nodes/soft ball/w2", "is 0.5, must be at most 2 w1 = 0.4",
            [](SceneSpec& s) { find(s, "soft ball")->values["w1"] = 0.2; }),
      value("signed-plane", "soft rod", "distance", ref("rail"), "", "half_space or slab"),
      value("field-of-field", "soft rod", "distance", ref("soft ball"), "", "LevelMismatch"),
      value("contour-of-rod", "soft bar", "w1", ref("rod"), "/contour", "NotRayLinear"),
      value("contour-of-plane", "soft bar", "w1", ref("wall"), "/contour", "UnboundedContour"),
      value("contour-inside", "soft bar", "w1", ref("stone"), "/contour", "ContourInsideObject"),
      value("rod-with-contour", "soft bar", "distance", ref("rod"), "", "NotRayLinear"),
      other("contour-elsewhere", "/nodes/soft bar/w1/contour", "OriginMismatch",
            [](SceneSpec& s) {
              s.nodes.push_back(part("aside", "place", {{"of", ref("outline")}, {"move", Numbers{1, 0, 0}}}));
              find(s, "soft bar")->values["w1"] = ref("aside");
            }),
      other("coupled-hollow", "/nodes/soft bar/w2", "must be at most 2 w1 of every direction = 0.25",
            [](SceneSpec& s) {
              // w1 = 2 * 4.5 / 8 - 1 = 0.125 along x.
              find(s, "soft bar")->values["inner"] = std::string("coupled");
              find(s, "outline")->values["a"] = 4.5;
            }),
      value("erosion-overreach", "eroded", "by", ref("outline"), "", "ErosionOverreach"),
      value("zero-level-of-soft", "flat", "of", ref("soft ball"), "", "LevelMismatch"),
      value("mixed-levels", "all", "of", refs({"soft bar", "ball"}), "/1", "LevelMismatch"),
  };
}

class BrokenScene : public testing::TestWithParam<Broken> {};

TEST_P(BrokenScene, IsRefusedWhereItIsBroken) {
  SceneSpec scene = sound();
  GetParam().change(scene);
  const std::vector<Problem> problems = problems_of(scene);
  ASSERT_FALSE(problems.empty()) << "builds";
  EXPECT_EQ(problems.front().where, GetParam().where) << problems.front().message;
  EXPECT_THAT(problems.front().message, testing::HasSubstr(GetParam().words));
}

std::string id_of(const testing::TestParamInfo<Broken>& info) {
  std::string id = info.param.id;
  std::replace(id.begin(), id.end(), '-', '_');
  return id;
}
INSTANTIATE_TEST_SUITE_P(Values, BrokenScene, testing::ValuesIn(broken_values()), id_of);
INSTANTIATE_TEST_SUITE_P(Structure, BrokenScene, testing::ValuesIn(broken_structure()), id_of);
INSTANTIATE_TEST_SUITE_P(Meaning, BrokenScene, testing::ValuesIn(broken_meaning()), id_of);

// Every broken scene is one change away from this one.
TEST(SoundScene, BuildsForEveryNodeInSpace) {
  SceneSpec scene = sound();
  for (const NodeSpec& node : sound().nodes) {
    if (find_node_kind(node.kind)->family == NodeFamily::profile) continue;
    SCOPED_TRACE(node.name);
    scene.solid = node.name;
    const Scene built = build_scene(scene);
    EXPECT_EQ(built.nodes, scene.nodes.size());
    EXPECT_THAT(built.warnings, testing::IsEmpty());
    EXPECT_FALSE(built.field.members().empty());
  }
}

TEST(SceneProblems, ComeAllAtOnceInTheOrderOfTheNodes) {
  SceneSpec scene = sound();
  find(scene, "bar")->values["a"] = -1.0;
  find(scene, "ball")->values["radius"] = 3.0;
  find(scene, "ball")->values["c"] = std::string("x");
  find(scene, "moved")->values["of"] = ref("bal");
  scene.solid = "nothing like it";
  std::vector<std::string> where;
  for (const Problem& p : problems_of(scene)) where.push_back(p.where);
  // "soft bar", "soft ball", "eroded", "all", ... use faulty nodes and stay silent.
  EXPECT_THAT(where, testing::ElementsAre("/nodes/bar/a", "/nodes/ball/radius", "/nodes/ball/c",
                                          "/nodes/moved/of", "/solid"));
}

TEST(SceneProblems, TurnIntoWarningsWhereASceneMayBeMeant) {
  for (const bool strict : {true, false}) {
    SceneSpec scene = sound();
    scene.strict = strict;
    find(scene, "soft bar")->values["w1"] = ref("stone");
    if (strict) {
      EXPECT_THAT(problems_of(scene), testing::Not(testing::IsEmpty()));
      continue;
    }
    const Scene built = build_scene(scene);
    ASSERT_EQ(built.warnings.size(), 1u);
    EXPECT_EQ(built.warnings[0].where, "/nodes/soft bar/w1/contour");
    EXPECT_THAT(built.warnings[0].message, testing::HasSubstr("ContourInsideObject"));
  }
}

}  // namespace
}  // namespace blendwright::test
