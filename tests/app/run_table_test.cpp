// What a person reads after a run: nothing is called good that was not measured, places are told to a
// thousandth of the blend, and files by their names.
#include "app/cli/run_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/cli/text_table.hpp"
#include "tests/app/job_support.hpp"

namespace blendwright::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

JobResult reducer() { return run_job(example_job("coaxial-cylinders")); }
std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }
SeamReport& seam(JobResult& result, std::size_t side) { return result.blends[0].stages.back().seams[side]; }

TEST(RunTable, SaysWhatWasNotMeasuredAndCountsItApart) {
  JobResult result = reducer();
  EXPECT_EQ(first_line(run_table(result, nullptr, "j")), "j: 1 blend, 2 seams, all within tolerance");
  seam(result, 1).measured = false;
  seam(result, 1).gap.worst = 1.0;  // left over: it counts for nothing
  const std::string one = run_table(result, nullptr, "j");
  EXPECT_EQ(first_line(one), "j: 1 blend, 2 seams, 1 within tolerance, 1 not measured (no primary)");
  EXPECT_THAT(one, AllOf(HasSubstr("reducer  to    G2     not measured\n"), Not(HasSubstr("1.0e+00"))));
  seam(result, 0).gap.worst = 1.0;
  EXPECT_EQ(first_line(run_table(result, nullptr, "j")),
            "j: 1 blend, 2 seams, 1 not within tolerance, 1 not measured (no primary)");
  seam(result, 0).measured = false;
  EXPECT_EQ(first_line(run_table(result, nullptr, "j")), "j: 1 blend, 2 seams, 2 not measured (no primary)");
}

TEST(RunTable, ExplainsBracketsOnceWhereThereAreSome) {
  JobResult result = reducer();
  EXPECT_THAT(run_table(result, nullptr, "j"), Not(HasSubstr("not asked")));
  for (BlendSideEntry& side : result.blends[0].entry.sides) side.side.continuity = Continuity::G1;
  const std::string text = run_table(result, nullptr, "j");
  const std::size_t at = text.find("  (...) not asked\n");
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(text.find("not asked", at + 20), std::string::npos);
}

TEST(RunTable, TellsPlacesFarFromTheOriginToAThousandthOfTheBlend) {
  JobSpec job = example_job("coaxial-cylinders");
  for (PrimaryEntry& p : job.primaries) std::get<PrimarySpec>(p.spec).placement.t += Vec3(1e6, -2e6, 3e6);
  job.tolerance.position = 1e-12;  // so that the gap is a finding, with its place
  const JobResult result = run_job([&] {
    JobSpec near = job;
    near.tolerance.position = 1e-6;  // what can be fitted out there
    return near;
  }());
  JobResult judged = result;
  judged.job.tolerance.position = 1e-12;
  const std::string text = run_table(judged, nullptr, "j");
  // Radius 1 around (1e6, -2e6): three decimals for a blend 4 wide.
  EXPECT_THAT(
      text,
      testing::ContainsRegex(
          R"(worst at v = [0-9.]+ \((1000000|999999)(\.[0-9]{1,3})?,-(2000000|1999999|1999998)(\.[0-9]{1,3})?,300000[0-3]\))"));
  EXPECT_THAT(text, testing::ContainsRegex(R"(gap .* at v = [0-9.]+ \((1000000|999999)(\.[0-9]{1,3})?, -)"));
  EXPECT_THAT(text, Not(HasSubstr("e+0")));
}

TEST(WrittenFiles, NamesEveryFileWithin80Columns) {
  JobOutputs outputs;
  outputs.files = {{"out/inch.step", "step", 26321},
                   {"out/inch.png", "png", 1},
                   {"out/inch.errors.png", "png", 1},
                   {"out/inch.report.json", "report", 1}};
  const std::string text = written_files(outputs, StepSchema::AP242);
  EXPECT_EQ(text, "wrote out/inch.step (AP242, 26 kB), inch.png, inch.errors.png, inch.report.json");
  for (int i = 0; i < 30; ++i)
    outputs.files.push_back({"out/inch.a-primary-" + std::to_string(i) + ".vtp", "vtp", 1});
  const std::string many = written_files(outputs, StepSchema::AP242);
  EXPECT_LE(widest_line(many), 80u);
  for (const WrittenFile& f : outputs.files) EXPECT_THAT(many, HasSubstr(f.path.filename().string()));
}

}  // namespace
}  // namespace blendwright::test
