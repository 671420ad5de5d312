// Every broken input of `offset`, `relate` and `collide` ends in one clear message and the right exit code,
// and leaves nothing behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/app/relations/relation_scenes.hpp"

namespace blendwright::test {
namespace {

using testing::HasSubstr;

struct BadCall {
  const char* name;
  const char* arguments;  ///< in a folder with the files below
  const char* words;      ///< of the message
  int code;
};

void PrintTo(const BadCall& bad, std::ostream* out) { *out << bad.name; }

const std::vector<BadCall> calls{
    // offset
    {"offset_nothing", "offset ball.json", "--distance, --shell, --round or --fillet must be given", 3},
    {"offset_two", "offset ball.json --distance 1 --round 1", "excludes", 2},
    {"offset_distance_nan", "offset ball.json --distance nan", "must be a finite number", 2},
    {"offset_distance_text", "offset ball.json --distance far", "must be a finite number", 2},
    {"offset_round_negative", "offset ball.json --round -1", "must be > 0", 2},
    {"offset_fillet_zero", "offset ball.json --fillet 0", "must be > 0", 2},
    {"offset_shell_one", "offset ball.json --shell 1", "must be two lengths inner,outer", 2},
    {"offset_shell_negative", "offset ball.json --shell=-1,2", "must be two lengths >= 0", 2},
    {"offset_shell_thin", "offset ball.json --shell 0,0", "--shell: InvalidParameter: is 0", 3},
    {"offset_kind", "offset ball.json --distance 1 --kind sphere", "--kind", 2},
    {"offset_kind_alone", "offset ball.json --round 1 --kind iso", "--kind requires --distance", 2},
    {"offset_tolerance_iso", "offset ball.json --distance 1 --kind iso --tolerance 1e-3",
     "must go with a ball", 3},
    {"offset_solid", "offset ball.json --solid bal --distance 1", "did you mean \"ball\"", 3},
    {"offset_missing_scene", "offset none.json --distance 1", "none.json: cannot be", 5},
    {"offset_broken_scene", "offset broken.json --distance 1", "broken.json: 1 problem", 3},
    {"offset_unbounded", "offset wall.json --distance 1", "--box: is missing", 3},
    {"offset_empty", "offset ball.json --distance -2", "leaves nothing of", 4},
    {"offset_format", "offset ball.json --distance 1 -o x.txt", "must end in \".vtp\"", 3},
    {"offset_memory", "offset ball.json --distance 1 --cells 100000 --max-memory 1M", "--max-memory", 3},
    {"offset_too_far", "offset ball.json --distance 1e300", "", 3},
    // relate
    {"relate_nothing", "relate", "SCENES is required", 2},
    {"relate_one", "relate ball.json", "is one scene, must be two, or one with --points", 3},
    {"relate_three", "relate ball.json ball.json ball.json", "are 3, must be one or two", 3},
    {"relate_unit", "relate ball.json inch.json", "is in in, must be in mm", 3},
    {"relate_node", "relate ball.json#bal ball.json", "did you mean \"ball\"", 3},
    {"relate_missing", "relate ball.json none.json", "none.json: cannot be", 5},
    {"relate_broken", "relate ball.json broken.json", "broken.json: 1 problem", 3},
    {"relate_tolerance", "relate ball.json ball.json --tolerance 0", "must be > 0", 2},
    {"relate_boxes", "relate ball.json ball.json --max-boxes 0", "--max-boxes", 2},
    {"relate_domain", "relate ball.json ball.json --domain 0,0,0,1,1", "must be six numbers", 2},
    {"relate_unbounded", "relate wall.json wall.json", "--domain", 3},
    {"relate_mode_alone", "relate ball.json ball.json --mode value", "--mode requires --points", 2},
    {"relate_points_missing", "relate ball.json --points none.csv", "none.csv: cannot be read", 5},
    {"relate_points_broken", "relate ball.json --points broken.csv", "line 2: has 2 values", 3},
    {"relate_points_twice", "relate - --points -", "is standard input, as a scene is", 3},
    {"relate_output", "relate ball.json --points points.csv -o places.vtp", "must end in \".csv\"", 3},
    {"relate_output_exists", "relate ball.json --points points.csv -o points.csv", "already exists", 5},
    // collide
    {"collide_one", "collide ball.json", "must be at least two", 3},
    {"collide_unit", "collide ball.json inch.json", "--convert-units", 3},
    {"collide_missing", "collide ball.json none.json", "none.json: cannot be", 5},
    {"collide_broken", "collide broken.json ball.json", "broken.json: 1 problem", 3},
    {"collide_stdin_twice", "collide - -", "names standard input twice", 3},
    {"collide_unbounded", "collide wall.json wall.json", "--domain: ", 3},
    {"collide_domain", "collide ball.json ball.json --domain 0,0,0,1,1,0", "lower corner below", 2},
    {"collide_tolerance", "collide ball.json ball.json --tolerance -1", "must be > 0", 2},
    {"collide_axis", "collide ball.json ball.json --projected w", "--projected", 2},
    {"collide_expect", "collide ball.json ball.json --expect touch", "--expect", 2},
    {"collide_motion_missing", "collide ball.json ball.json --motion none.csv", "none.csv: cannot be read",
     5},
    {"collide_motion_folder", "collide ball.json ball.json --motion folder", "it is a folder", 5},
    {"collide_motion_broken", "collide ball.json ball.json --motion motion.csv", "motion.csv: 2 problems", 3},
    {"collide_motion_names", "collide ball.json ball.json --motion motion.csv", "line 3: body is \"3\"", 3},
    {"collide_motion_empty", "collide ball.json ball.json --motion empty.csv", "is empty", 3},
    {"collide_motion_unbounded", "collide ball.json wall.json --motion good.csv", "", 3},
    {"collide_motion_domain", "collide ball.json ball.json --motion good.csv --domain 0,0,0,1,1,1",
     "excludes", 2},
    {"collide_motion_bars", "collide ball.json ball.json --motion good.csv --projected x", "excludes", 2},
    {"collide_all_alone", "collide ball.json ball.json --all", "--all requires --motion", 2},
    {"collide_cells_format", "collide ball.json ball.json --cells x.vtp", "must end in \".vtu\" or \".png\"",
     3},
    {"collide_cells_of_three", "collide ball.json ball.json ball.json --cells x.vtu", "must be with two", 3},
    {"collide_cells_motion", "collide ball.json ball.json --motion good.csv --cells x.vtu", "excludes", 2},
    {"collide_output_format", "collide ball.json ball.json -o x.txt", "must end in \".csv\"", 3},
    {"collide_output_twice", "collide ball.json ball.json --cells a.vtu --cells a.vtu",
     "must name each file once", 3},
    {"collide_output_folder", "collide ball.json ball.json --force -o folder.csv",
     "folder.csv: is not a regular file", 5},
    {"collide_output_below_file", "collide ball.json ball.json -o ball.json/x.csv", "ball.json", 5},
};

class BadCalls : public testing::TestWithParam<BadCall> {};

TEST_P(BadCalls, EndInOneClearMessageAndLeaveNothing) {
  const BadCall& bad = GetParam();
  const SceneFolder files;
  files.add("ball.json", R"({ "nodes": { "ball": { "kind": "sphere", "radius": 1 } }, "solid": "ball" })");
  files.add("inch.json", ball_scene(1.0, 0.0, 0.0, 0.0, "in"));
  files.add("wall.json", R"({ "solid": { "kind": "quadric", "coefficients": [0,0,0,0,0,0,1,0,0,-0.5] } })");
  files.add("broken.json", R"({ "solid": { "kind": "sphere", "radius": -1 } })");
  files.add("points.csv", "0,0,0\n");
  files.add("broken.csv", "0,0,0\n1,2\n");
  files.add("good.csv", "step,body,x,y,z\n0,1,0,0,0\n");
  files.add("motion.csv", "step,body,x,y,z\n0,1,0,0,0\n0,3,0,0,0\n0,2,0,0\n");
  files.add("empty.csv", "");
  fs::create_directory(files / "folder");
  fs::create_directory(files / "folder.csv");
  const std::size_t before = files.files().size();
  const Outcome outcome = files.run(bad.arguments);
  EXPECT_EQ(outcome.code, bad.code) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr(bad.words));
  EXPECT_NE(outcome.err, "");
  EXPECT_THAT(outcome.err, testing::Not(HasSubstr("unexpected error")));
  EXPECT_EQ(files.files().size(), before);
}

INSTANTIATE_TEST_SUITE_P(Table, BadCalls, testing::ValuesIn(calls),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(BadCallTable, HasAtLeastTwentyFiveRows) {
  std::set<std::string> names;
  for (const BadCall& bad : calls) names.insert(bad.name);
  EXPECT_EQ(names.size(), calls.size());
  EXPECT_GE(names.size(), 25u);
}

}  // namespace
}  // namespace blendwright::test
