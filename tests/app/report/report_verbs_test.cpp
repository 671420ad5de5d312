// --report, --fairness and --pull as a user types them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/json/json_value.hpp"
#include "kernel/base/text_file.hpp"
#include "tests/app/job_support.hpp"
#include "tests/app/program.hpp"
#include "tests/app/report/xml_reading.hpp"

namespace blendwright::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string job_path(const char* name) { return quoted_path(specs_folder() / (std::string(name) + ".json")); }

TEST(ReportFlag, WritesAPageThatSaysHowItWasMade) {
  const TemporaryFolder folder("report-flag");
  const std::string page = (folder.path() / "page.html").string();
  const std::string call = "verify " + job_path("coaxial-cylinders") + " --report " + page;
  const Outcome run = run_program(call);
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string text = read_text_file(page, 64 << 20);
  ASSERT_NE(read_xml(text), nullptr);
  EXPECT_THAT(text, HasSubstr("blendwright verify "));
  EXPECT_THAT(text, HasSubstr("--report " + page));
  // A second run is refused before any work, and leaves the first page alone.
  const Outcome again = run_program(call);
  EXPECT_EQ(again.code, 5);
  EXPECT_THAT(again.err, HasSubstr("page.html"));
  EXPECT_EQ(read_text_file(page, 64 << 20), text);
  EXPECT_EQ(run_program(call + " --force").code, 0);
}

TEST(ReportFlag, GoesWithBlendAndMesh) {
  const TemporaryFolder folder("report-verbs");
  const std::string at = folder.path().string();
  const Outcome made = run_program("blend " + job_path("coaxial-cylinders") + " -o " + at + "/out --report " +
                                   at + "/blend.html");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(read_text_file(at + "/blend.html", 64 << 20),
              HasSubstr("Measured on the STEP file, read back."));
  const fs::path scene = fs::path(BLENDWRIGHT_SOURCE_DIR) / "examples/scenes/s3-tee.json";
  const Outcome meshed =
      run_program("mesh " + quoted_path(scene) + " --cells 30 --report " + at + "/mesh.html");
  ASSERT_EQ(meshed.code, 0) << meshed.err;
  EXPECT_NE(read_xml(read_text_file(at + "/mesh.html", 64 << 20)), nullptr);
}

TEST(ReportFlag, OfAnotherEndingIsRefused) {
  const Outcome run = run_program("verify " + job_path("coaxial-cylinders") + " --report page.pdf");
  EXPECT_EQ(run.code, 3);
  EXPECT_THAT(run.err, HasSubstr("--report"));
  EXPECT_THAT(run.err, HasSubstr("must end in .html"));
}

TEST(FairnessFlag, PrintsTheFiguresOfTheReport) {
  const std::string call = "verify " + job_path("coaxial-cylinders") + " --fairness --pull 0,0,1";
  const Outcome table = run_program(call), json = run_program(call + " --json");
  ASSERT_EQ(table.code, 0) << table.err;
  ASSERT_EQ(json.code, 0) << json.err;
  const JsonValue report = parse_json(json.out);
  const JsonValue& stage = report.find("blends")->items()->front().find("stages")->items()->back();
  const JsonValue& fairness = *stage.find("fairness");
  EXPECT_GT(*fairness.find("bending_energy")->number(), 0.0);
  // The wall runs from radius 1 to radius 2 over a length of 3 along the pull and leaves both cylinders along
  // it: somewhere its slope is at least the mean one, nowhere is it overhanging.
  const double low = *fairness.find("least_draft_deg")->find("value")->number(),
               high = *fairness.find("most_draft_deg")->find("value")->number();
  const double mean = Radians(std::atan2(1.0, 3.0)).degrees();
  EXPECT_GE(std::max(std::abs(low), std::abs(high)), mean);
  EXPECT_NEAR(std::min(std::abs(low), std::abs(high)), 0.0, 1e-3);
  EXPECT_THAT(table.out, HasSubstr("bending energy"));
  EXPECT_THAT(table.out, HasSubstr("draft"));
  // Not asked for: null.
  const JsonValue plain = parse_json(run_program("verify " + job_path("coaxial-cylinders") + " --json").out);
  EXPECT_TRUE(
      plain.find("blends")->items()->front().find("stages")->items()->back().find("fairness")->is_null());
}

TEST(PullFlag, MustBeADirectionAndNeedsFairness) {
  for (const char* bad : {"0,0,0", "1,2", "a,b,c", "1,2,nan", ""}) {
    const Outcome run = run_program("verify " + job_path("coaxial-cylinders") + " --fairness --pull '" +
                                    std::string(bad) + "'");
    EXPECT_EQ(run.code, 2) << bad;
    EXPECT_THAT(run.err, HasSubstr("--pull")) << bad;
  }
  EXPECT_EQ(run_program("verify " + job_path("coaxial-cylinders") + " --pull 0,0,1").code, 2);
}

}  // namespace
}  // namespace blendwright::test
