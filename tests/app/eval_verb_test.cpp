// `eval` as a user meets it: every figure of a point, in every form, and what it says of broken points.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "app/json/json_value.hpp"
#include "app/pipeline/eval_job.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "tests/app/program.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A ball of radius 4 about the origin and one about (20, 0, 0), whose name needs quotes in a csv file.
const std::string scene = R"({
  "nodes": {
    "ball": { "kind": "soft_object", "distance": { "kind": "lp_metric", "a": 8, "b": 8, "c": 8, "n": 2 } },
    "a \"far\", soft ball": { "kind": "place", "of": "ball", "move": [20, 0, 0] },
    "both": { "kind": "soft_blend", "of": ["ball", "other"] },
    "other": { "kind": "soft_object", "distance": { "kind": "place", "move": [20, 0, 0],
               "of": { "kind": "lp_metric", "a": 8, "b": 8, "c": 8, "n": 2 } } }
  },
  "solid": "both"
})";

class EvalVerb : public testing::Test {
 protected:
  EvalVerb() { write(folder_ / "scene.json", scene); }
  [[nodiscard]] Outcome run(const std::string& arguments, const std::string& points = "") const {
    write(folder_ / "points.csv", points);
    return run_program("eval " + quoted_path(folder_ / "scene.json") + " " + arguments,
                       "cd " + quoted_path(folder_.path()) + "; ");
  }
  Folder folder_;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

TEST_F(EvalVerb, PrintsEveryFigureOfAPoint) {
  const Outcome outcome = run("--points points.csv", "4,0,0\n0,0,0\n0,0,30\n20,3,0\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "x,y,z,value,inside,gx,gy,gz,mean_curvature,gaussian_curvature,member");
  // On the surface: |gradient| = P'(1/2)/8 = 2/8.
  const auto on = fields_of(lines[1]);
  ASSERT_EQ(on.size(), 11u);
  EXPECT_NEAR(std::stod(on[3]), 0.5, 1e-12);
  EXPECT_NEAR(std::stod(on[5]), -0.25, 1e-12);
  EXPECT_NEAR(std::stod(on[8]), 0.25, 1e-9);
  EXPECT_NEAR(std::stod(on[9]), 0.0625, 1e-9);
  EXPECT_EQ(on[10], "ball");
  // Where there is no gradient there are no curvatures.
  const auto centre = fields_of(lines[2]);
  EXPECT_THAT(centre, ElementsAre("0", "0", "0", "1", "1", "0", "0", "0", "", "", "ball"));
  EXPECT_EQ(fields_of(lines[3])[3], "0");
  EXPECT_EQ(fields_of(lines[3])[4], "0");
  EXPECT_EQ(fields_of(lines[4])[4], "1");
  EXPECT_EQ(fields_of(lines[4])[10], "other");
}

TEST_F(EvalVerb, ReadsWhatItPrinted) {
  const Outcome first = run("--points points.csv", "4,0,0\n0.1,0.2,-1e-3\n19.5,3,0.333333333333333\n");
  ASSERT_EQ(first.code, 0);
  const Outcome again = run("--points points.csv", first.out);
  EXPECT_EQ(again.out, first.out);
  const Outcome piped = run("--points - < points.csv", first.out);
  EXPECT_EQ(piped.out, first.out);
}

TEST_F(EvalVerb, GivesTheSameInEveryForm) {
  std::string points;
  Rng rng(5);
  for (int i = 0; i < 70'000; ++i) {  // more than one block
    for (int k = 0; k < 3; ++k) points += number_text(uniform(rng, -8, 8)) + (k < 2 ? "," : "\n");
  }
  const Outcome text = run("--points points.csv", points);
  ASSERT_EQ(text.code, 0) << text.err;
  const Outcome csv = run("--points points.csv -o new/values.csv", points);
  EXPECT_EQ(csv.code, 0) << csv.err;
  EXPECT_THAT(csv.out, HasSubstr("wrote new/values.csv, 70000 points"));
  EXPECT_TRUE(content(folder_ / "new/values.csv") == text.out);
  EXPECT_TRUE(run("--points points.csv --threads 1", points).out == text.out);
  ASSERT_EQ(run("--points points.csv --quiet -o values.vtp", points).code, 0);
  const TriMesh cloud = read_mesh(folder_ / "values.vtp");
  ASSERT_EQ(cloud.points.size(), 70'000u);
  const auto lines = lines_of(text.out);
  for (const std::size_t i : {std::size_t{0}, std::size_t{12'345}, std::size_t{69'999}}) {
    const auto fields = fields_of(lines[i + 1]);
    EXPECT_EQ(number_text(cloud.points[i].x()), fields[0]);
    EXPECT_EQ(number_text(cloud.columns[0].values[i]), fields[3]);
    EXPECT_EQ(number_text(cloud.columns[1].values[i]), fields[4]);
    EXPECT_EQ(number_text(cloud.columns[2].values[3 * i + 2]), fields[7]);
    EXPECT_EQ(cloud.columns[5].labels.at(static_cast<std::size_t>(cloud.columns[5].values[i])), fields[10]);
  }
  EXPECT_EQ(run("--points values.vtp", points).out, text.out);  // the points of a cloud are points again
}

TEST_F(EvalVerb, PrintsJsonWithNullForWhatIsNotDefined) {
  const Outcome outcome = run("--json --points points.csv", "x,y,z\n4,0,0\n0,0,0\n");
  const JsonValue json = parse_json(outcome.out);
  EXPECT_EQ(*json.find("solid")->text(), "both");
  EXPECT_EQ(*json.find("level")->text(), "half level");
  const auto& points = *json.find("points")->items();
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(*(*points[0].find("point")->items())[0].number(), 4.0);
  EXPECT_NEAR(*points[0].find("mean_curvature")->number(), 0.25, 1e-9);
  EXPECT_TRUE(points[1].find("mean_curvature")->is_null());
  EXPECT_TRUE(*points[1].find("inside")->boolean());
  EXPECT_EQ(parse_json(run("--json --points points.csv", "").out).find("points")->items()->size(), 0u);
}

TEST_F(EvalVerb, QuotesNamesWithCommas) {
  const Outcome outcome = run("--solid 'a \"far\", soft ball' --points points.csv", "20,0,1\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<FieldSample> samples{{{1, 2, 3}, 0.5, true, {0, 0, 1}, std::nullopt, 0}};
  EXPECT_EQ(csv_lines(samples, {"a \"b\", c"}), "1,2,3,0.5,1,0,0,1,,,\"a \"\"b\"\", c\"\n");
  EXPECT_EQ(csv_lines(samples, {}), "1,2,3,0.5,1,0,0,1,,,\n");
}

TEST_F(EvalVerb, NamesEveryBrokenLineAndWritesNothing) {
  const Outcome outcome = run("--points points.csv -o values.csv", "1,2,3\n1,2\n1,nan,3\n1,2,3,4\n0x1,2,3\n");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("points.csv: 4 problems"), HasSubstr("  line 2: has 2 values, must have 3"),
                    HasSubstr("  line 3: is \"nan\", must be a finite number"),
                    HasSubstr("  line 4: has 4 values"), HasSubstr("  line 5: ")));
  EXPECT_FALSE(fs::exists(folder_ / "values.csv"));
}

TEST_F(EvalVerb, RefusesWhatItCannotReadOrWrite) {
  const struct {
    const char *arguments, *words;
    int code;
  } wrong[] = {{"--points missing.csv", "missing.csv: cannot be read", 5},
               {"--points missing.vtp", "missing.vtp: cannot be read", 5},
               {"--points .", "cannot be read (it is a folder)", 5},
               {"--points points.csv -o values.txt", "must end in \".csv\" or \".vtp\"", 3},
               {"--points points.csv -o points.csv", "already exists; use --force", 5},
               {"--points points.csv --solid bal", "did you mean \"ball\"", 3},
               {"--points points.csv -o points.csv/values.csv", "points.csv", 5}};
  for (const auto& [arguments, words, code] : wrong) {
    SCOPED_TRACE(arguments);
    const Outcome outcome = run(arguments, "1,2,3\n");
    EXPECT_EQ(outcome.code, code);
    EXPECT_THAT(outcome.err, HasSubstr(words));
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(folder_.files(), testing::UnorderedElementsAre("scene.json", "points.csv"));
  }
  EXPECT_THAT(run_program("eval - --points - < /dev/null").err, HasSubstr("standard input"));
}

TEST_F(EvalVerb, LeavesNothingWhenTheDiskIsFull) {
  std::string points;
  for (int i = 0; i < 5000; ++i) points += "1,2," + std::to_string(i) + "\n";
  write(folder_ / "points.csv", points);
  for (const char* name : {"values.csv", "values.vtp"}) {
    const Outcome outcome =
        run_program("eval scene.json --points points.csv -o " + std::string(name),
                    "cd " + quoted_path(folder_.path()) + "; trap '' XFSZ; ulimit -f 8; exec");
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(name), Not(HasSubstr("unfinished"))));
    EXPECT_THAT(folder_.files(), testing::UnorderedElementsAre("scene.json", "points.csv"));
  }
}

}  // namespace
}  // namespace blendwright::test
