// report.json: the same bytes every time, true to its schema, and a verdict that follows from its own
// figures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "app/json/job_reader.hpp"
#include "kernel/base/parallel_for.hpp"
#include "tests/app/mini_schema.hpp"
#include "tests/app/program.hpp"

namespace blendwright::test {
namespace {

using testing::IsEmpty;

JobResult example(const std::string& name) {
  return run_job(read_job_file(fs::path(BLENDWRIGHT_SOURCE_DIR) / "examples/specs" / (name + ".json")));
}

double largest(const JsonValue& side, const char* figure) {
  return *side.find(figure)->find("largest")->number();
}

TEST(Report, FollowsItsSchemaWithAndWithoutTimes) {
  const JobResult result = example("coaxial-cylinders");
  const MiniSchema schema(report_schema());
  EXPECT_THAT(schema.violations(parse_json(report_json(result, nullptr, false))), IsEmpty());
  EXPECT_THAT(schema.violations(parse_json(report_json(result, nullptr, true))), IsEmpty());
}

TEST(Report, HasClockReadingsOnlyWhenAsked) {
  const JobResult result = example("coaxial-cylinders");
  EXPECT_EQ(parse_json(report_json(result, nullptr, false)).find("times"), nullptr);
  EXPECT_NE(parse_json(report_json(result, nullptr, true)).find("times"), nullptr);
}

TEST(Report, DoesNotListItselfButEveryOtherFile) {
  const JobResult result = example("coaxial-cylinders");
  JobOutputs outputs;
  outputs.files = {{"out/x.step", "step", 7}, {"out/x.report.json", "report", 0}};
  const JsonValue report = parse_json(report_json(result, &outputs, false));
  const auto& files = *report.find("files")->items();
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(*files[0].find("name")->text(), "x.step");
  EXPECT_EQ(*files[0].find("bytes")->number(), 7.0);
}

TEST(Report, SaysWhichSidesWereNotMeasured) {
  JobResult result = example("coaxial-cylinders");
  result.blends[0].stages.back().seams[1].measured = false;
  const JsonValue report = parse_json(report_json(result, nullptr, false));
  const JsonValue& stage = report.find("blends")->items()->front().find("stages")->items()->back();
  EXPECT_TRUE(*stage.find("from")->find("measured")->boolean());
  EXPECT_FALSE(*stage.find("to")->find("measured")->boolean());
}

TEST(Report, IsTheSameBytesAgainAndOnOneThread) {
  const std::string first = report_json(example("open-blend"), nullptr, false);
  EXPECT_EQ(report_json(example("open-blend"), nullptr, false), first);
  const ThreadLimit one(1);
  EXPECT_EQ(report_json(example("open-blend"), nullptr, false), first);
}

TEST(Report, VerdictFollowsFromTheFiguresBesideIt) {
  for (const char* name : {"open-blend", "fig4-eq11-printed"}) {
    SCOPED_TRACE(name);
    const JsonValue report = parse_json(report_json(example(name), nullptr, false));
    const JsonValue& tolerance = *report.find("tolerance");
    const auto within = [&](const JsonValue& side, const char* figure, const char* limit) {
      return largest(side, figure) <= *tolerance.find(limit)->number();
    };
    std::size_t sides = 0;
    for (const JsonValue& blend : *report.find("blends")->items())
      for (const JsonValue& stage : *blend.find("stages")->items())
        for (const char* which : {"from", "to"}) {
          const JsonValue& side = *stage.find(which);
          std::string reached = "none";
          if (within(side, "gap", "position")) {
            reached = "G0";
            if (within(side, "angle_deg", "angle_deg") && *side.find("folded")->number() == 0.0)
              reached = within(side, "curvature", "curvature") ? "G2" : "G1";
          }
          EXPECT_EQ(*side.find("reached")->text(), reached) << which;
          EXPECT_GT(*side.find("samples")->number(), 100.0);
          ++sides;
        }
    EXPECT_EQ(sides, 4u);  // two stages in memory, two sides
  }
}

TEST(Report, SaysWhatWasAskedAndUsed) {
  const JobResult result = example("open-blend");
  const JsonValue report = parse_json(report_json(result, nullptr, false));
  EXPECT_EQ(*report.find("job")->text(), "open-blend");
  EXPECT_EQ(report.find("input_hash")->text()->size(), 16u);
  const JsonValue& blend = report.find("blends")->items()->front();
  EXPECT_EQ(*blend.find("shape")->find("mode")->text(), "chord");
  EXPECT_EQ(*blend.find("shape")->find("order")->number(), 6.0);  // one side asks for G2
  EXPECT_EQ(*blend.find("shape")->find("family")->text(), "tension1");
  EXPECT_EQ(*blend.find("stages")->items()->front().find("from")->find("asked")->text(), "G2");
  EXPECT_LE(*blend.find("fit")->find("position_bound")->number(),
            *blend.find("fit")->find("position_asked")->number());
}

TEST(Report, WritesANumberThatIsNoneAsNullAndDoesNotPassIt) {
  JobResult result = example("coaxial-cylinders");
  ASSERT_TRUE(verified(result));
  result.blends[0].stages.back().seams[0].gap.worst = std::numeric_limits<double>::quiet_NaN();
  const JsonValue report = parse_json(report_json(result, nullptr, false));
  EXPECT_FALSE(*report.find("verified")->boolean());
  const JsonValue& side =
      *report.find("blends")->items()->front().find("stages")->items()->back().find("from");
  EXPECT_TRUE(side.find("gap")->find("largest")->is_null());
  EXPECT_EQ(*side.find("reached")->text(), "none");
  EXPECT_THAT(MiniSchema(report_schema()).violations(report), IsEmpty());
}

}  // namespace
}  // namespace blendwright::test
