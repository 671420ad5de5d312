// `fit` of a scene: the scene file that is written has the numbers of the scan.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/json/json_value.hpp"
#include "app/pipeline/fit_scene_job.hpp"
#include "tests/app/program.hpp"

namespace blendwright::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

fs::path scenes() { return fs::path(BLENDWRIGHT_SOURCE_DIR) / "examples/scenes"; }

const std::string example_arguments() {
  return quoted_path(scenes() / "fit-scan.json") + " --points " + quoted_path(scenes() / "fit-scan.csv") +
         " --from-points --robust-scale 0.3";
}

class FitSceneVerb : public testing::Test {
 protected:
  [[nodiscard]] Outcome run(const std::string& arguments) const {
    return run_program("fit " + arguments, "cd " + quoted_path(folder_.path()) + "; ");
  }
  Folder folder_;
};

double value_of(const SceneSpec& scene, const std::string& node, const std::string& key) {
  for (const NodeSpec& n : scene.nodes)
    if (n.name == node) return std::get<double>(n.values.at(key));
  throw std::logic_error("no node " + node);
}

TEST_F(FitSceneVerb, FindsTheCushionThatWasScanned) {
  const Outcome outcome = run(example_arguments() + " -o found.json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("9 numbers fitted"));
  EXPECT_THAT(outcome.out, HasSubstr("wrote found.json"));
  const std::string text = content(folder_ / "found.json");
  EXPECT_THAT(text, HasSubstr("// A superquadric for a scan"));  // comments stay
  const SceneSpec found = read_scene(text);
  // The scan was made of a, b = 22, 15, c = 9, n1 = 2.6, n2 = 2 with noise of 0.1 mm from one side: 5 %.
  const double a = value_of(found, "form", "a"), b = value_of(found, "form", "b");
  EXPECT_NEAR(std::max(a, b), 22.0, 1.1);
  EXPECT_NEAR(std::min(a, b), 15.0, 0.75);
  EXPECT_NEAR(value_of(found, "form", "c"), 9.0, 0.45);
  EXPECT_NEAR(value_of(found, "form", "n1"), 2.6, 0.13);
  EXPECT_NEAR(value_of(found, "form", "n2"), 2.0, 0.10);
}

TEST_F(FitSceneVerb, SaysTheSameInJson) {
  const Outcome outcome =
      run(quoted_path(scenes() / "fit-scan.json") + " --points " + quoted_path(scenes() / "fit-scan.csv") +
          " --unknown body/move=-100,100 --unknown form/a=5,50 --robust-scale 2 --json");
  const JsonValue report = parse_json(outcome.out, "");
  EXPECT_EQ(*report.find("count")->number(), 900.0);
  EXPECT_EQ(report.find("numbers")->items()->size(), 4u);
  EXPECT_EQ(*report.find("numbers")->items()->at(0).find("name")->text(), "form/a");
  EXPECT_TRUE(*report.find("converged")->boolean());
  EXPECT_LT(*report.find("rms")->number(), *report.find("rms_before")->number());
}

TEST_F(FitSceneVerb, ChangesOnlyWhatIsAskedForAndIsReadAgain) {
  write(folder_ / "scene.json",
        "{ \"nodes\": { // two parts\n  \"body\": { \"kind\": \"place\", \"move\": [12, -7, 30],\n"
        "    \"of\": { \"kind\": \"lp_metric\", \"a\": 20, \"b\": \"3*5\", \"c\": 9, \"n\": 2 } } }, "
        "\"solid\": \"body\" }\n");
  const Outcome outcome = run("scene.json --points " + quoted_path(scenes() / "fit-scan.csv") +
                              " --unknown body/turn --unknown /nodes/body/of/a=10,40 --robust-scale 1 -o -");
  const SceneSpec found = read_scene(outcome.out);
  EXPECT_THAT(outcome.out, HasSubstr("// two parts"));
  EXPECT_THAT(outcome.out, HasSubstr("\"b\": \"3*5\""));
  EXPECT_THAT(outcome.out, HasSubstr("\"turn_deg\""));
  EXPECT_NE(value_of(found, "/nodes/body/of", "a"), 20.0);
}

TEST_F(FitSceneVerb, SaysWhatItCannotUse) {
  write(folder_ / "job.json", R"({"primaries": {}, "blends": {}})");
  write(folder_ / "nan.csv", "x,y,z\n1,2,3\n1,nan,3\n");
  write(folder_ / "empty.csv", "x,y,z\n");
  const std::string scene = quoted_path(scenes() / "fit-scan.json") + " ";
  struct Bad {
    std::string arguments;
    int code;
    const char* words;
  };
  const Bad bad[] = {
      {scene, 3, "--points: is missing, must be a file of points"},
      {scene + "--points none.csv", 5, "none.csv"},
      {scene + "--points nan.csv", 3, "line 3"},
      {scene + "--points empty.csv", 3, "--points: there are 0, must be at least 11"},
      {scene + "--points nan.csv --unknown form", 3, "--unknown: is \"form\", must be like form/a=1,10"},
      {scene + "--points nan.csv --unknown form/a=1", 3, "must be like form/a=1,10"},
      {example_arguments() + " --unknown form/q=1,2", 3, "form/q is not a number that can be fitted"},
      {example_arguments() + " --unknown form/a=9,1", 3, "must have a lower bound below its upper one"},
      {example_arguments() + " --objective thin_plate", 3, "--objective: is for blends"},
      {example_arguments() + " --robust-scale 0", 2, "must be > 0"},
      {scene + "--from-points", 2, "--points"},
      {"job.json --points empty.csv", 3, "--points: is for scenes"},
  };
  for (const Bad& b : bad) {
    SCOPED_TRACE(b.arguments);
    const Outcome outcome = run(b.arguments + " -o found.json");
    EXPECT_EQ(outcome.code, b.code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(b.words));
    EXPECT_FALSE(fs::exists(folder_ / "found.json"));
  }
}

}  // namespace
}  // namespace blendwright::test
