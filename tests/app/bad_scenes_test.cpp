// Every broken scene ends in one clear message with its JSON pointer and the right exit code, and leaves
// nothing behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "app/json/scene_reader.hpp"
#include "tests/app/program.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Distances and soft objects that the broken node "x" may use.
const std::string sound = R"(
  "ball": { "kind": "lp_metric", "a": 4, "b": 4, "c": 4, "n": 2 },
  "bar": { "kind": "superquadric", "a": 2, "b": 2, "c": 8, "n1": 2, "n2": 20 },
  "slab": { "kind": "slab", "normal": [0, 0, 1], "a": 1 },
  "segment": { "kind": "segment_skeleton", "p0": [0, 0, 0], "p1": [3, 0, 0], "radius": 1 },
  "moved": { "kind": "place", "of": "bar", "move": [1, 0, 0] },
  "disc": { "kind": "lp_profile", "a": 1, "b": 1, "n": 2 },
  "big": { "kind": "lp_metric", "a": 12, "b": 12, "c": 12, "n": 2 },
  "soft": { "kind": "soft_object", "distance": "ball" },
  "soft bar": { "kind": "soft_object", "distance": "bar" },
  "zero": { "kind": "zero_level", "of": "ball", "form": "difference" })";

struct BadScene {
  std::string name;
  std::string text;   ///< "{...}" or any text: the file; else the node "x" of a scene
  std::string where;  ///< JSON pointer, "" for the file as a whole
  std::string words;  ///< of the message
  int code = 3;       ///< 3: bad input; 4: no result
  std::string flags{};
  int problems = 1;
};

void PrintTo(const BadScene& bad, std::ostream* out) { *out << bad.name; }

BadScene node(std::string name, const std::string& node, const std::string& below, std::string words,
              int problems = 1) {
  return {std::move(name),
          "{ \"nodes\": {" + sound + ",\n  \"x\": " + node + " },\n  \"solid\": \"x\" }",
          "/nodes/x" + below,
          std::move(words),
          3,
          "",
          problems};
}
/// A sound scene with this solid, and flags that break it.
BadScene flags(std::string name, const std::string& solid, const std::string& flags, std::string where,
               std::string words, int code = 3) {
  return {std::move(name),
          "{ \"nodes\": {" + sound + " },\n  \"solid\": \"" + solid + "\" }",
          std::move(where),
          std::move(words),
          code,
          flags};
}

/// A sound scene with adjustable numbers; `below`: where, inside "adjust".
BadScene adjust(std::string name, const std::string& entries, const std::string& below, std::string words,
                int problems = 1) {
  return {std::move(name),
          "{ \"nodes\": {" + sound + " },\n  \"solid\": \"soft\",\n  \"adjust\": " + entries + " }",
          "/adjust" + below,
          std::move(words),
          3,
          "",
          problems};
}

std::string chain(int count) {
  std::string text = "{ \"nodes\": {\n";
  for (int i = 0; i < count; ++i)
    text += "\"n" + std::to_string(i) + R"(": { "kind": "complement", "of": "n)" +
            std::to_string((i + 1) % count) + "\" },\n";
  return text + sound + "}, \"solid\": \"n0\" }";
}

std::string nested(int levels) {
  std::string text = "{ \"solid\": ";
  for (int i = 0; i < levels; ++i) text += R"({ "kind": "complement", "of": )";
  return text + "\"ball\"" + std::string(static_cast<std::size_t>(levels), '}') + "}";
}

std::vector<BadScene> texts() {
  const std::string ball = R"({ "kind": "lp_metric", "a": 4, "b": 4, "c": 4, "n": 2 })";
  return {
      {"empty", "", "", "is empty; the shortest scene has \"solid\""},
      {"blanks", " \n\t", "", "is empty; the shortest scene has \"solid\""},
      {"only_comments", "// nothing\n", "", "unexpected end of input"},
      {"not_an_object", "[1, 2]", "", "is a list of 2 values, must be an object"},
      {"unclosed", "{ \"solid\": " + ball, "", "unexpected end of input"},
      {"syntax_error", "{ \"solid\" " + ball + " }", "", "line 1, column 11"},
      {"trailing_comma", "{ \"solid\": " + ball + ", }", "", "a comma before '}' or ']' is one too many"},
      {"trailing_text", "{ \"solid\": " + ball + " } x", "", "expected end of input"},
      {"nan_literal", "{ \"solid\": { \"kind\": \"lp_metric\", \"a\": NaN } }", "",
       "NaN and Infinity are no numbers"},
      {"number_too_large", "{ \"solid\": { \"kind\": \"lp_metric\", \"a\": 1e999 } }", "", "1e999"},
      {"not_utf8", "{ \"solid\": \"\xC3\x28\" }", "", "ill-formed UTF-8"},
      {"utf16", std::string("\xFF\xFE{\0}\0", 6), "", "is in UTF-16, must be in UTF-8"},
      {"a_hundred_thousand_levels", nested(100'000), "", "nested deeper than 64 levels"},
      {"duplicate_names",
       R"({ "nodes": { "a": )" + ball + R"(, "b": )" + ball + R"(, "a": )" + ball + R"( }, "solid": "a" })",
       "/nodes/a", "appears twice"},
      {"duplicate_key", R"({ "solid": { "kind": "lp_metric", "a": 4, "b": 4, "a": 4, "c": 4, "n": 2 } })",
       "/solid/a", "appears twice"},
      {"no_solid", R"({ "nodes": { "a": )" + ball + " } }", "/solid", "is missing"},
      {"solid_unknown", R"({ "nodes": { "body": )" + ball + R"( }, "solid": "bodi" })", "/solid",
       "did you mean \"body\""},
      {"solid_wrong_type", R"({ "solid": 3 })", "/solid", "must be the name of a node or a node"},
      {"no_nodes", R"({ "nodes": {}, "solid": "a" })", "/solid", "must be the name of a node", 3, "", 2},
      {"nodes_wrong_type", R"({ "nodes": [], "solid": "a" })", "/nodes", "must be an object"},
      {"unknown_top_key", "{ \"solid\": " + ball + ", \"nods\": {} }", "/nods", "did you mean \"nodes\""},
      {"unknown_unit", "{ \"solid\": " + ball + ", \"unit\": \"inch\" }", "/unit",
       "is \"inch\", must be \"mm\""},
      {"strict_wrong_type", "{ \"solid\": " + ball + ", \"strict\": \"yes\" }", "/strict",
       "must be true or false"},
      {"constant_named_t", "{ \"let\": { \"t\": 1 }, \"solid\": " + ball + " }", "/let/t",
       "formulas use already"},
      {"constant_not_finite", "{ \"let\": { \"r\": \"1/0\" }, \"solid\": " + ball + " }", "/let/r",
       "infinite"},
      {"name_of_a_pointer", R"({ "nodes": { "/solid": )" + ball + R"( }, "solid": "/solid" })",
       "/nodes/~1solid", "not start with \"/\""},
      {"name_empty", R"({ "nodes": { "": )" + ball + R"( }, "solid": "" })", "/nodes/", "a name must have"},
      {"name_with_control_character",
       "{ \"nodes\": { \"a\\u0007\": " + ball + " }, \"solid\": \"a\\u0007\" }", "/nodes/a?",
       "no control characters"},
      {"cycle_of_a_thousand", chain(1000), "/nodes/n0/of", "must not be a cycle"},
      {"many_problems",
       R"({ "unit": 1, "nodes": { "a": { "kind": "lp_metric", "a": -1, "b": 0, "c": "x", "n": 2 } }, "solid": "b" })",
       "/nodes/a/c", "is not known", 3, "", 5},
  };
}

std::vector<BadScene> values() {
  return {
      node("node_wrong_type", "7", "", "is 7, must be a node"),
      node("kind_missing", "{ \"a\": 1 }", "/kind", "is missing, must be a kind of node"),
      node("kind_wrong_type", "{ \"kind\": [] }", "/kind", "must be a kind of node"),
      node("kind_unknown", R"({ "kind": "soft_blnd", "of": ["soft"] })", "/kind",
           "did you mean \"soft_blend\""),
      node("key_unknown", R"({ "kind": "soft_object", "distanc": "ball" })", "/distanc",
           "did you mean \"distance\"", 2),
      node("key_missing", R"({ "kind": "lp_metric", "a": 4, "b": 4, "c": 4 })", "/n", "is missing"),
      node("radius_negative", R"({ "kind": "lp_metric", "a": -4, "b": 4, "c": 4, "n": 2 })", "/a",
           "is -4, must be > 0"),
      node("radius_zero", R"({ "kind": "lp_metric", "a": 0, "b": 4, "c": 4, "n": 2 })", "/a",
           "is 0, must be > 0"),
      node("exponent_zero", R"({ "kind": "lp_metric", "a": 4, "b": 4, "c": 4, "n": 0 })", "/n", "must be"),
      node("number_wrong_type", R"({ "kind": "lp_metric", "a": true, "b": 4, "c": 4, "n": 2 })", "/a",
           "is true, must be a number"),
      node("formula_unknown_name", R"({ "kind": "lp_metric", "a": "2*r", "b": 4, "c": 4, "n": 2 })", "/a",
           "\"r\" is not known"),
      node("formula_not_finite", R"({ "kind": "lp_metric", "a": "1/0", "b": 4, "c": 4, "n": 2 })", "/a",
           "infinite"),
      node("half_an_integer",
           R"({ "kind": "polar_bar", "profile": { "kind": "rose", "a": 1, "k": 2.5, "eps": 0.2 },
                                   "c": 4, "n": 2 })",
           "/profile/k", "whole number"),
      node("softness_negative", R"({ "kind": "soft_object", "distance": "ball", "softness": -0.5 })",
           "/softness", "is -0.5, must be >= 0"),
      node("potential_unknown", R"({ "kind": "soft_object", "distance": "ball", "potential": "gausian" })",
           "/potential", "did you mean \"gaussian\""),
      node("reference_unknown", R"({ "kind": "soft_object", "distance": "bal" })", "/distance",
           "did you mean \"ball\""),
      node("reference_wrong_type", R"({ "kind": "soft_object", "distance": 4 })", "/distance",
           "must be the name of a node"),
      node("reference_to_itself", R"({ "kind": "complement", "of": "x" })", "/of", "must not be a cycle"),
      node(
          "cycle_through_a_contour",
          R"({ "kind": "soft_object", "distance": "ball", "w1": { "contour": { "kind": "place", "of": "x" } } })",
          "/w1/contour", "must not be a cycle"),
      node("of_empty", R"({ "kind": "soft_blend", "of": [] })", "/of", "at least"),
      node("of_wrong_type", R"({ "kind": "soft_blend", "of": "soft" })", "/of", "must be a list of nodes"),
      node("of_holds_a_number", R"({ "kind": "soft_blend", "of": ["soft", 1] })", "/of/1",
           "must be the name of a node"),
      node("complement_of_two", R"({ "kind": "complement", "of": ["soft", "soft bar"] })", "/of",
           "must be the name of a node"),
      node("soft_blend_of_distances", R"({ "kind": "soft_blend", "of": ["soft", "ball"] })", "/of/1",
           "LevelMismatch"),
      node("ricci_one_of_soft_objects",
           R"({ "kind": "ricci_union_one", "of": ["soft", "soft bar"], "n": 2 })", "/of/0", "LevelMismatch",
           2),
      node("lse_zero_of_distances", R"({ "kind": "lse_union_zero", "of": ["ball", "bar"], "n": 2 })", "/of/0",
           "LevelMismatch", 2),
      node("min_of_mixed_levels", R"({ "kind": "min", "of": ["zero", "soft"] })", "/of/1", "LevelMismatch"),
      node("soft_object_of_a_field", R"({ "kind": "soft_object", "distance": "soft" })", "/distance",
           "LevelMismatch"),
      node("erosion_overreach", R"({ "kind": "erosion", "of": "bar", "by": "ball", "n": 1 })", "/by",
           "ErosionOverreach"),
      node("erosion_of_a_segment", R"({ "kind": "erosion", "of": "segment", "by": "ball", "n": 1 })", "/of",
           "NotRayLinear"),
      node("dilation_by_something_moved", R"({ "kind": "dilation", "of": "ball", "by": "moved", "n": 1 })",
           "/by", "OriginMismatch"),
      node("ray_scaling_by_a_slab", R"({ "kind": "ray_scaling", "of": "ball", "by": "slab", "n": 1 })", "/by",
           "must"),
      node("contour_inside_object", R"({ "kind": "soft_object", "distance": "ball",
           "w1": { "contour": { "kind": "lp_metric", "a": 1, "b": 1, "c": 1, "n": 2 } } })",
           "/w1/contour", "ContourInsideObject"),
      node("contour_unbounded",
           R"({ "kind": "soft_object", "distance": "ball", "w1": { "contour": "slab" } })", "/w1/contour",
           "UnboundedContour"),
      node("contour_not_ray_linear",
           R"({ "kind": "soft_object", "distance": "ball", "w1": { "contour": "segment" } })", "/w1/contour",
           "NotRayLinear"),
      node("contour_elsewhere",
           R"({ "kind": "soft_object", "distance": "ball", "w1": { "contour": "moved" } })", "/w1/contour",
           "OriginMismatch"),
      node("contour_missing", R"({ "kind": "soft_object", "distance": "ball", "w1": {} })", "/w1/contour",
           "is missing"),
      node("contour_with_more",
           R"({ "kind": "soft_object", "distance": "ball", "w1": { "contour": "big", "n": 2 } })", "/w1/n",
           "unknown key"),
      node("w1_negative", R"({ "kind": "soft_object", "distance": "ball", "w1": -1 })", "/w1",
           "is -1, must be"),
      node("placement_singular", R"({ "kind": "affine", "of": "ball",
           "matrix": [[1, 2, 3], [2, 4, 6], [0, 0, 1], [0, 0, 0]] })",
           "/matrix", "singular"),
      node("matrix_not_a_number", R"({ "kind": "affine", "of": "ball",
           "matrix": [[1, 0, 0], [0, "0/0", 0], [0, 0, 1], [0, 0, 0]] })",
           "/matrix/1/1", "not a number"),
      node("matrix_huge", R"({ "kind": "affine", "of": "ball",
           "matrix": [[1e300, 0, 0], [0, 1e300, 0], [0, 0, 1e300], [0, 0, 0]] })",
           "", "leave the range of numbers"),
      node("matrix_of_three_rows", R"({ "kind": "affine", "of": "ball",
           "matrix": [[1, 0, 0], [0, 1, 0], [0, 0, 1]] })",
           "/matrix", "must be 4 rows of 3 numbers"),
      node("matrix_row_too_short", R"({ "kind": "affine", "of": "ball",
           "matrix": [[1, 0, 0], [0, 1], [0, 0, 1], [0, 0, 0]] })",
           "/matrix/1", "has 2 numbers, must have 3"),
      node("matrix_of_texts", R"({ "kind": "affine", "of": "ball", "matrix": ["a", "b", "c", "d"] })",
           "/matrix/0", "must be a list of numbers", 4),
      node("scale_zero", R"({ "kind": "place", "of": "ball", "scale": 0 })", "/scale", "must be"),
      node("axis_zero", R"({ "kind": "place", "of": "ball", "axis": [0, 0, 0], "turn_deg": 10 })", "/axis",
           "must have a direction"),
      node("normal_zero", R"({ "kind": "plane", "normal": [0, 0, 0], "a": 1 })", "/normal", "must"),
      node("profile_as_a_node", R"({ "kind": "soft_object", "distance": "disc" })", "/distance",
           "must be a node in space"),
      node("node_as_a_profile", R"({ "kind": "polar_bar", "profile": "ball", "c": 4, "n": 2 })", "/profile",
           "must be a profile"),
      node("star_without_depth",
           R"({ "kind": "polar_bar", "profile": { "kind": "star", "a": 1, "k": 5, "sigma": 0,
                                      "m": 1 }, "c": 4, "n": 2 })",
           "/profile/sigma", "must be > 0"),
      node("scale_union_p_too_large",
           R"({ "kind": "scale_union_half", "of": ["soft", "soft bar"], "r1": 0.5, "r2": 0.5, "p": 0.25 })",
           "/p", "must be"),
      node("sweep_along_nothing", R"({ "kind": "sweep_line", "p0": [1, 1, 1], "p1": [1, 1, 1], "u": [1, 0, 0],
           "profile": "disc", "scale": [1, 1], "twist_deg": 0, "cap": 1, "m": 2 })",
           "/p1", "must be another one"),
      node("sweep_formula_of_x",
           R"({ "kind": "sweep_curve", "curve": ["x", "t", 0], "t": [0, 1], "profile": "disc",
           "scale": [1, 1], "twist_deg": 0, "cap": 1, "m": 2 })",
           "/curve/0", "\"x\" is not known"),
      node(
          "problem_of_an_inner_node",
          R"({ "kind": "soft_blend", "of": ["soft", { "kind": "soft_object", "distance": { "kind": "lp_metric",
                "a": 1, "b": 1, "c": 1, "n": -1 } }] })",
          "/of/1/distance/n", "is -1"),
  };
}

std::vector<BadScene> adjusted() {
  return {
      adjust("adjust_wrong_type", "[1, 2]", "", "must be an object: {\"NODE/KEY\": [lowest, highest], ...}"),
      adjust("adjust_without_a_key", R"({ "ball": [1, 9] })", "/ball", "must be named NODE/KEY"),
      adjust("adjust_of_nothing", R"({ "": [1, 9] })", "/", "must be named NODE/KEY"),
      adjust("adjust_node_unknown", R"({ "bal/a": [1, 9] })", "/bal~1a", "did you mean \"ball\""),
      adjust("adjust_key_unknown", R"({ "bar/n3": [1, 9] })", "/bar~1n3",
             "a superquadric can be adjusted in \"a\", \"b\", \"c\", \"n1\" or \"n2\""),
      adjust("adjust_key_misspelt", R"({ "segment/radus": [1, 9] })", "/segment~1radus",
             "did you mean \"radius\""),
      adjust("adjust_a_word", R"({ "soft/potential": [0, 1] })", "/soft~1potential",
             "is about \"potential\", which is \"blanc\""),
      adjust("adjust_a_node", R"({ "soft/distance": [0, 1] })", "/soft~1distance", "which is a node"),
      adjust("adjust_kind", R"({ "soft/kind": [0, 1] })", "/soft~1kind", "is about \"kind\""),
      adjust("adjust_a_whole_list", R"({ "moved/move": [0, 4] })", "/moved~1move",
             "must say which number, as in \"moved/move/0\""),
      adjust("adjust_beyond_a_list", R"({ "moved/move/3": [0, 4] })", "/moved~1move~13", "is about item 3"),
      adjust("adjust_item_of_a_number", R"({ "ball/a/0": [0, 4] })", "/ball~1a~10",
             "must be about \"ball/a\""),
      adjust("adjust_list_left_out", R"({ "moved/axis/0": [0, 4] })", "/moved~1axis~10",
             "which the node leaves out; write it there first"),
      adjust("adjust_no_range", R"({ "ball/a": 4 })", "/ball~1a", "must be a list of 2 numbers"),
      adjust("adjust_three_numbers", R"({ "ball/a": [1, 4, 9] })", "/ball~1a", "must be a list of 2 numbers"),
      adjust("adjust_no_numbers", R"({ "ball/a": ["low", 9] })", "/ball~1a/0", "is not known"),
      adjust("adjust_crossed", R"({ "ball/a": [9, 1] })", "/ball~1a",
             "is [9, 1], must be the lowest value, then a higher one"),
      adjust("adjust_empty_range", R"({ "ball/a": [4, 4] })", "/ball~1a", "then a higher one"),
      adjust("adjust_value_outside", R"({ "ball/a": [5, 9] })", "/ball~1a",
             "is [5, 9], must hold the scene's own value, 4"),
      adjust("adjust_default_outside", R"({ "soft/softness": [0.5, 1] })", "/soft~1softness",
             "must hold the scene's own value, 0"),
      adjust("adjust_beyond_the_key", R"({ "ball/a": [-1, 9] })", "/ball~1a/0",
             "is -1, must be > 0 as \"a\" must"),
      adjust(
          "adjust_many",
          R"({ "bal/a": [1, 9], "ball/a": [9, 1], "ball/q": [1, 2], "bar/a": [3, 4], "moved/move/0": [0, 2] })",
          "/bar~1a", "must hold the scene's own value, 2", 4),
  };
}

std::vector<BadScene> meshes() {
  return {
      flags("solid_flag_unknown", "soft", "--solid sfot", "--solid", "did you mean \"soft\""),
      flags("solid_is_a_profile", "disc", "", "/solid", "must be a node in space"),
      flags("solid_unbounded", "slab", "", "--box",
            "is unbounded, or its bounds are not known; give the box"),
      flags("nothing_in_the_box", "soft", "--box 50,50,50,60,60,60", "",
            "nothing of the surface lies in the box", 4),
      flags("inside_of_the_box_only", "soft", "--at-box open --box=-0.1,-0.1,-0.1,0.1,0.1,0.1", "",
            "nothing of the surface lies in the box", 4),
      flags("cell_beyond_memory", "soft", "--cell 1e-4", "--max-memory", "need about"),
      flags("little_memory", "soft", "--max-memory 64K", "--max-memory", "need about"),
      flags("cell_beyond_everything", "soft", "--cell 1e-300", "--cell", "which cuts the box into"),
      flags("extension_unknown", "soft", "-o body.stp", "--output", "must end in \".vtp\""),
      flags("no_extension", "soft", "-o body", "--output", "must end in \".vtp\""),
      flags("output_twice", "soft", "-o a.vtp -o a.vtp", "--output", "must name each file once"),
      flags("colour_unknown", "soft", "-o a.png --colour curvature", "--colour", "must be \"value\""),
  };
}

std::vector<BadScene> bad_scenes() {
  std::vector<BadScene> all = texts();
  for (auto* more : {values, adjusted, meshes})
    for (BadScene& bad : more()) all.push_back(std::move(bad));
  return all;
}

class BadScenes : public testing::TestWithParam<BadScene> {};

TEST_P(BadScenes, EndInOneClearMessageAndLeaveNothing) {
  const BadScene& bad = GetParam();
  const Folder folder, work;
  write(folder / "bad.json", bad.text);
  const Outcome outcome =
      run_program("mesh -o out.vtp -o deep/er/out.stl " + bad.flags + " " + quoted_path(folder / "bad.json"),
                  "cd " + quoted_path(work.path()) + ";");
  EXPECT_EQ(outcome.code, bad.code) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  // The message names the file at its start, and the place at the start of a line.
  EXPECT_EQ(outcome.err.rfind("bad.json: ", 0), 0u) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(bad.words));
  const std::string where = bad.where.empty() ? "" : "\n  " + bad.where + ": ";
  EXPECT_THAT(outcome.err, HasSubstr(where));
  const std::string count = bad.code != 3       ? ""
                            : bad.problems == 1 ? "bad.json: 1 problem\n"
                                                : "bad.json: " + std::to_string(bad.problems) + " problems\n";
  EXPECT_THAT(outcome.err, HasSubstr(count));
  EXPECT_THAT(work.files(), IsEmpty());
  EXPECT_FALSE(fs::exists(work / "deep"));
}

INSTANTIATE_TEST_SUITE_P(Table, BadScenes, testing::ValuesIn(bad_scenes()),
                         [](const auto& row) { return row.param.name; });

TEST(BadSceneTable, HasAtLeastFortyRowsAndItsSoundPartIsSound) {
  std::set<std::string> names;
  for (const BadScene& bad : bad_scenes()) names.insert(bad.name);
  EXPECT_GE(names.size(), 40u);
  EXPECT_EQ(names.size(), bad_scenes().size());
  EXPECT_NO_THROW((void)build_scene_text("{ \"nodes\": {" + sound + " }, \"solid\": \"soft\" }", "x.json"));
}

/// An example with a few bytes changed: it is read or refused with problems, never anything else.
TEST(MutatedScenes, AreReadOrRefused) {
  std::vector<std::string> examples;
  for (const auto& entry : fs::directory_iterator(fs::path(BLENDWRIGHT_SOURCE_DIR) / "examples/scenes"))
    if (entry.path().extension() == ".json") examples.push_back(content(entry.path()));
  std::sort(examples.begin(), examples.end());
  ASSERT_GE(examples.size(), 10u);
  constexpr std::string_view bytes = "{}[]\",:.-+eE019 \n\\/antrufls\x80\xFF";
  std::size_t read = 0, refused = 0;
  for_all(
      [&](Rng& rng) {
        const auto below = [&](std::size_t n) {
          return static_cast<std::size_t>(integer(rng, 0, static_cast<int>(n) - 1));
        };
        std::string text = examples[below(examples.size())];
        for (std::size_t change = 1 + below(4); change-- > 0;) {
          const std::size_t at = below(text.size());
          const char byte = bytes[below(bytes.size())];
          const std::size_t how = below(3);
          if (how == 0)
            text[at] = byte;
          else if (how == 1)
            text.insert(at, 1, byte);
          else
            text.erase(at, 1 + below(3));
        }
        try {
          static_cast<void>(build_scene_text(text, "mutated.json"));
          ++read;
        } catch (const InputError& e) {
          ASSERT_FALSE(e.problems().empty());
          for (const Problem& p : e.problems()) EXPECT_FALSE(p.message.empty());
          ++refused;
        }
      },
      400);
  // Both happen: comments and digits may change freely, brackets may not.
  EXPECT_GT(read, (read + refused) / 50);
  EXPECT_GT(refused, (read + refused) / 4);
}

}  // namespace
}  // namespace blendwright::test
