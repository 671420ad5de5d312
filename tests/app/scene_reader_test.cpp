// Scene files become the nodes they describe, and every problem is found at once.
#include "app/json/scene_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <numbers>

#include "app/json/json_value.hpp"
#include "app/json/scene_writer.hpp"
#include "tests/app/program.hpp"

namespace blendwright::test {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<Problem> problems(const std::string& text) {
  try {
    static_cast<void>(build_scene_text(text, "scene.json"));
  } catch (const InputError& e) {
    return e.problems();
  }
  return {};
}

template <class T>
const T& value(const NodeSpec& node, const char* key) {
  return std::get<T>(node.values.at(key));
}

const std::string ball = R"({ "kind": "lp_metric", "a": 2, "b": 3, "c": 4, "n": 2 })";

TEST(SceneReader, ReadsNodesByNameAndTheirDefaults) {
  const SceneSpec spec = read_scene(R"({ "nodes": { "ball": )" + ball +
                                    R"(, "soft ball": { "kind": "soft_object", "distance": "ball",
                                    "potential": "wyvill" } }, "solid": "soft ball" })");
  EXPECT_EQ(spec.unit, LengthUnit::millimetre);
  EXPECT_TRUE(spec.strict);
  EXPECT_EQ(spec.solid, "soft ball");
  ASSERT_EQ(spec.nodes.size(), 2u);
  const NodeSpec expected{
      "ball", "lp_metric", {{"a", 2.0}, {"b", 3.0}, {"c", 4.0}, {"n", 2.0}}, "/nodes/ball"};
  EXPECT_EQ(spec.nodes[0], expected);
  EXPECT_EQ(value<NodeRef>(spec.nodes[1], "distance"), NodeRef{"ball"});
  EXPECT_EQ(value<std::string>(spec.nodes[1], "potential"), "wyvill");
}

TEST(SceneReader, NamesNodesInPlaceByTheirPointer) {
  const SceneSpec spec = read_scene(R"({ "nodes": { "a/b": { "kind": "soft_object", "distance": )" + ball +
                                    R"(, "w1": { "contour": )" + ball + R"( } } },
    "solid": { "kind": "place", "of": "a/b", "move": [1, 2, 3] } })");
  ASSERT_EQ(spec.nodes.size(), 4u);
  EXPECT_EQ(spec.nodes[0].name, "a/b");
  EXPECT_EQ(spec.nodes[0].where, "/nodes/a~1b");
  EXPECT_EQ(spec.nodes[1].name, "/nodes/a~1b/distance");
  EXPECT_EQ(spec.nodes[1].where, "/nodes/a~1b/distance");
  EXPECT_EQ(value<NodeRef>(spec.nodes[0], "distance"), NodeRef{spec.nodes[1].name});
  EXPECT_EQ(spec.nodes[2].name, "/nodes/a~1b/w1/contour");
  EXPECT_EQ(value<NodeRef>(spec.nodes[0], "w1"), NodeRef{spec.nodes[2].name});
  EXPECT_EQ(spec.nodes[3].name, "/solid");
  EXPECT_EQ(spec.solid, "/solid");
  EXPECT_EQ(value<std::vector<double>>(spec.nodes[3], "move"), (std::vector<double>{1, 2, 3}));
}

TEST(SceneReader, ReadsFormulasAndConstants) {
  const SceneSpec spec = read_scene(R"json({
    "let": { "r": "2*pi", "e3": -4 }, "unit": "in", "strict": false,
    "nodes": { "bar": { "kind": "sweep_curve", "curve": ["r*cos(t)", "2e3*r + e3", 0], "t": [0, "r/2"],
                        "profile": { "kind": "lp_profile", "a": "r", "b": 1, "n": 2 } },
               "turned": { "kind": "affine", "of": "bar",
                           "matrix": [[1, 0, 0], [0, "r", 0], [0, 0, 1], ["-e3", 0, 0]] } },
    "solid": "turned" })json");
  constexpr double r = 2.0 * std::numbers::pi;
  EXPECT_EQ(spec.unit, LengthUnit::inch);
  EXPECT_FALSE(spec.strict);
  EXPECT_EQ(value<double>(spec.nodes[1], "a"), r);
  EXPECT_EQ(value<std::vector<double>>(spec.nodes[0], "t"), (std::vector<double>{0.0, r / 2}));
  EXPECT_EQ(value<std::vector<std::string>>(spec.nodes[0], "curve"),
            (std::vector<std::string>{"(6.283185307179586)*cos(t)", "2e3*(6.283185307179586) + (-4)", "0"}));
  const auto& matrix = value<std::vector<std::vector<double>>>(spec.nodes[2], "matrix");
  EXPECT_EQ(matrix, (std::vector<std::vector<double>>{{1, 0, 0}, {0, r, 0}, {0, 0, 1}, {4, 0, 0}}));
}

TEST(SceneReader, ReadsCommentsAndAByteOrderMark) {
  EXPECT_EQ(read_scene("\xEF\xBB\xBF// [ {\n{ \"solid\": /* { */ " + ball + " }").nodes.size(), 1u);
}

TEST(SceneReader, TellsProblemsOfTheTextAndOfTheSceneTogetherInTheOrderOfTheFile) {
  const auto found = problems(R"({
    "unit": "mile",
    "nodes": {
      "a": { "kind": "lp_metric", "a": -1, "b": true, "c": 1, "n": 2 },
      "b": { "kind": "lp_metrc" },
      "c": { "kind": "place", "of": "bb", "move": [1, "x", 2] },
      "d": 7
    },
    "solid": "e" })");
  EXPECT_THAT(found, ElementsAre(Field(&Problem::where, "/unit"),
                                 AllOf(Field(&Problem::where, "/nodes/a/a"),
                                       Field(&Problem::message, HasSubstr("is -1"))),
                                 AllOf(Field(&Problem::where, "/nodes/a/b"),
                                       Field(&Problem::message, HasSubstr("is true, must be a number"))),
                                 AllOf(Field(&Problem::where, "/nodes/b/kind"),
                                       Field(&Problem::message, HasSubstr("did you mean \"lp_metric\""))),
                                 AllOf(Field(&Problem::where, "/nodes/c/of"),
                                       Field(&Problem::message, HasSubstr("must be the name of a node"))),
                                 Field(&Problem::where, "/nodes/c/move/1"),
                                 Field(&Problem::where, "/nodes/d"), Field(&Problem::where, "/solid")));
}

TEST(SceneReader, TellsAMistakeOnce) {
  // A value that cannot be read is not missing, and a node that cannot be read is not unknown.
  const auto found = problems(R"({ "nodes": { "a": { "kind": "lp_metric", "a": null, "b": 1, "c": 1, "n": 2 },
                                              "b": [], "c": { "kind": "place", "of": "b", "move": [1, 2, 3] } },
                                   "solid": "c" })");
  EXPECT_THAT(found, ElementsAre(Field(&Problem::where, "/nodes/a/a"), Field(&Problem::where, "/nodes/b")));
}

TEST(SceneReader, SaysWhatEachTypeOfValueMustBe) {
  const struct {
    const char *node, *where, *words;
  } wrong[] = {
      {R"({ "kind": "lp_metric", "a": {}, "b": 1, "c": 1, "n": 2 })", "/a", "must be a number"},
      {R"({ "kind": "rose", "a": 1, "k": [], "eps": 0 })", "/k", "must be a number"},
      {R"({ "kind": "plane", "a": 1, "normal": 3 })", "/normal", "must be a point [x, y, z]"},
      {R"({ "kind": "plane", "a": 1, "normal": [0, 0, null] })", "/normal/2", "is null, must be a number"},
      {R"({ "kind": "generalized_distance", "n": 2, "normals": 1 })", "/normals", "must be a list of points"},
      {R"({ "kind": "generalized_distance", "n": 2, "normals": [1] })", "/normals/0",
       "must be a list of numbers"},
      {R"({ "kind": "asymmetric_superellipsoid", "x": true, "y": [1, 1], "z": [1, 1], "n": 2 })", "/x",
       "must be a list of 2 numbers"},
      {R"({ "kind": "affine", "of": "a", "matrix": {} })", "/matrix", "must be 4 rows of 3 numbers"},
      {R"({ "kind": "soft_object", "distance": "a", "potential": 1 })", "/potential", "\"blanc\""},
      {R"({ "kind": "soft_object", "distance": 1 })", "/distance", "must be the name of a node"},
      {R"({ "kind": "soft_object", "distance": "a", "w1": [] })", "/w1", "must be a number"},
      {R"({ "kind": "soft_object", "distance": "a", "w1": {} })", "/w1/contour", "is missing"},
      {R"({ "kind": "soft_object", "distance": "a", "w1": { "contour": "a", "x": 1 } })", "/w1/x",
       "unknown key"},
      {R"({ "kind": "soft_blend", "of": "a" })", "/of", "must be a list of nodes"},
      {R"({ "kind": "soft_blend", "of": ["a", 2] })", "/of/1", "must be the name of a node"},
      {R"({ "kind": "sweep_curve", "curve": "t", "t": [0, 1], "profile": "p" })", "/curve",
       "must be a list of 3 formulas of t"},
      {R"({ "kind": "sweep_curve", "curve": ["t", "u", 0], "t": [0, 1], "profile": "p" })", "/curve/1",
       "\"u\" is not known"},
      {R"({ "kind": 3 })", "/kind", "is 3, must be a kind of node"},
      {R"({ })", "/kind", "is missing, must be a kind of node"}};
  for (const auto& [node, where, words] : wrong) {
    SCOPED_TRACE(node);
    const auto found =
        problems(R"({ "nodes": { "a": )" + ball + ", \"x\": " + node + R"( }, "solid": "a" })");
    EXPECT_THAT(found, testing::Contains(AllOf(Field(&Problem::where, std::string("/nodes/x") + where),
                                               Field(&Problem::message, HasSubstr(words)))));
  }
}

TEST(SceneReader, ChoosesAnotherSolidAndNamesNearOnes) {
  const std::string text = R"({ "nodes": { "ball": )" + ball + R"(, "box": { "kind": "place", "of": )" +
                           ball + R"(, "move": [9, 0, 0] } }, "solid": "ball" })";
  EXPECT_EQ(build_scene_text(text, "scene.json", "box").spec.solid, "box");
  EXPECT_EQ(build_scene_text(text, "scene.json", "/nodes/box/of").spec.solid, "/nodes/box/of");
  try {
    static_cast<void>(build_scene_text(text, "scene.json", "bal"));
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_EQ(e.problems().at(0).where, "--solid");
    EXPECT_THAT(e.problems().at(0).message, HasSubstr("did you mean \"ball\""));
  }
}

TEST(SceneReader, ReadsAHundredThousandNodes) {
  std::string text = "{ \"nodes\": { \"n0\": " + ball;
  constexpr int count = 100'000;
  for (int i = 1; i < count; ++i)
    text += ",\n\"n" + std::to_string(i) + R"(": { "kind": "lp_metric", "a": 2, "b": 3.25, "c": 4, "n": 2 })";
  text += "}, \"solid\": \"n0\" }";
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(read_scene(text).nodes.size(), static_cast<std::size_t>(count));
  // Generous: the point is that the time grows with the size and not with its square.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(SceneReader, RefusesAHundredThousandLevels) {
  std::string text = "{ \"solid\": ";
  for (int i = 0; i < 100'000; ++i) text += R"({ "kind": "complement", "of": )";
  EXPECT_THAT(problems(text + ball + std::string(100'001, '}')),
              ElementsAre(Field(&Problem::message, HasSubstr("nested deeper than 64 levels"))));
}

TEST(SceneReader, KeepsTheNameAndHashOfTheFile) {
  const std::string text = "{ \"solid\": " + ball + " }";
  const SceneFile scene = build_scene_text(text, "parts/ball.json");
  EXPECT_EQ(scene.name, "ball");
  EXPECT_EQ(scene.source_hash.size(), 16u);
  EXPECT_NE(scene.source_hash, build_scene_text(text + " ", "parts/ball.json").source_hash);
  EXPECT_EQ(build_scene_text(text, "-").name, "scene");
}

TEST(SceneReader, ReadsAdjustableNumbersAndLeavesTheSceneAsItIs) {
  const std::string start = R"({ "let": { "most": 9 }, "nodes": {
    "a/b": { "kind": "place", "of": { "kind": "sphere", "radius": 4 }, "move": [1, 2, 3] } }, "solid": "a/b")";
  const SceneFile plain = build_scene_text(start + " }", "x.json");
  EXPECT_TRUE(plain.adjust.empty());
  const SceneFile scene = build_scene_text(
      start +
          R"(, "adjust": { "a/b/move/1": [-2, "most"], "/nodes/a~1b/of/radius": [1, 9], "a/b/scale": [0.5, 2] } })",
      "x.json");
  EXPECT_EQ(scene.spec, plain.spec);
  ASSERT_EQ(scene.adjust.size(), 3u);
  EXPECT_EQ(scene.adjust[0].node, "a/b");
  EXPECT_EQ(scene.adjust[0].key, "move");
  EXPECT_EQ(scene.adjust[0].index, 1u);
  EXPECT_EQ(scene.adjust[0].range.lo, -2.0);
  EXPECT_EQ(scene.adjust[0].range.hi, 9.0);
  EXPECT_EQ(adjusted_number(scene.spec, scene.adjust[0]), 2.0);
  EXPECT_EQ(adjusted_number(scene.spec, scene.adjust[1]), 4.0);
  EXPECT_EQ(adjusted_number(scene.spec, scene.adjust[2]), 1.0);  // the default of what is left out
  for (const SceneAdjust& a : scene.adjust)
    EXPECT_EQ(adjusted_number(with_number(scene.spec, a, 1.25), a), 1.25) << a.name;
}

TEST(SceneWriter, WidensTheRangeOfANumberThatLeavesIt) {
  const std::string text = R"({ "solid": { "kind": "lp_metric", "a": 4, "b": 4, "c": 4, "n": 2 }, // a ball
  "adjust": { "/solid/a": [2, 6], "/solid/b": [3, 5] } })";
  SceneSpec spec = read_scene(text);
  for (NodeSpec& node : spec.nodes) node.values["a"] = 8.0, node.values["b"] = 2.5, node.values["c"] = 3.0;
  EXPECT_EQ(scene_text(text, spec),
            R"({ "solid": { "kind": "lp_metric", "a": 8, "b": 2.5, "c": 3, "n": 2 }, // a ball
  "adjust": { "/solid/a": [2, 8], "/solid/b": [2.5, 5] } })");
  EXPECT_EQ(scene_text(text, read_scene(text)), text);
}

TEST(SceneWriter, RefusesWhatWouldReadAsAnotherScene) {
  const std::string text = R"({ "solid": { "kind": "lp_metric", "a": 4, "b": 4, "c": 4, "n": 2 } })";
  SceneSpec spec = read_scene(text);
  spec.strict = false;  // no number
  EXPECT_THROW((void)scene_text(text, spec), InputError);
}

}  // namespace
}  // namespace blendwright::test
