// The two measurements of gaps and angles on whole jobs: they agree on every example at every stage, and a
// disagreement is told as what it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/cli/console.hpp"
#include "app/cli/run_table.hpp"
#include "tests/app/job_support.hpp"
#include "tests/app/mini_schema.hpp"

namespace blendwright::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<SecondFigure> lengths(const BlendReport& stage) {
  std::vector<SecondFigure> all;
  for (const SecondSeam& s : stage.second->seams) all.insert(all.end(), {s.gap, s.surface_gap});
  if (stage.second->closing) all.push_back(stage.second->closing->gap);
  return all;
}
std::vector<SecondFigure> angles(const BlendReport& stage) {
  std::vector<SecondFigure> all;
  for (const SecondSeam& s : stage.second->seams) all.push_back(s.angle);
  if (stage.second->closing) all.push_back(stage.second->closing->angle);
  return all;
}

TEST(SecondPathOfJobs, AgreesOnEveryExampleAndItsFile) {
  double gap = 0.0, angle = 0.0;
  std::size_t figures = 0, places = 0;
  for (const auto& entry : std::filesystem::directory_iterator(specs_folder())) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path().stem().string());
    const TemporaryFolder folder("second-path");
    JobSpec job = example_job(entry.path().stem());
    job.output.formats = {OutputFormat::step};
    JobResult result = run_job(job);
    const JobOutputs outputs = write_outputs(result, {.folder = folder.path()});
    EXPECT_THAT(program_defects(result), IsEmpty());
    for (const BlendResult& blend : result.blends) {
      ASSERT_EQ(blend.stages.size(), 3u);
      for (const BlendReport& stage : blend.stages) {
        ASSERT_TRUE(stage.second);
        for (std::size_t side = 0; side < 2; ++side) {
          EXPECT_EQ(stage.second->seams[side].gap.places, 9u);
          EXPECT_GE(stage.second->seams[side].surface_gap.places, 9u);
          EXPECT_GE(stage.second->seams[side].angle.places, 7u);  // a cusp has no normal
        }
        for (const SecondFigure& f : lengths(stage)) {
          gap = std::max(gap, f.difference);
          places += f.places;
          EXPECT_LE(f.bound, 0.1 * job.tolerance.position);  // else agreeing would say little
        }
        for (const SecondFigure& f : angles(stage)) {
          angle = std::max(angle, f.difference);
          places += f.places;
          EXPECT_LE(f.bound, 0.1 * job.tolerance.angle.value);
        }
        figures += lengths(stage).size() + angles(stage).size();
      }
    }
  }
  std::cout << figures << " figures at " << places << " places: gaps differ by at most " << gap
            << " mm, angles by " << Radians(angle).degrees() << " deg\n";
  EXPECT_GE(figures, 20u * 18u);
}

JobResult reducer() { return run_job(example_job("coaxial-cylinders")); }

TEST(SecondPathOfJobs, TellsADisagreementAsADefectOfTheProgram) {
  JobResult result = reducer();
  EXPECT_THAT(run_table(result, nullptr, "j"), HasSubstr("  measured twice: gaps agree to "));
  EXPECT_EQ(exit_code_of(result, nullptr), exit_done);
  SecondFigure& figure = result.blends[0].stages[1].second->seams[0].gap;
  figure.first = 2e-8;
  figure.second = 3e-8;
  figure.difference = 1e-8;
  const auto defects = program_defects(result);
  ASSERT_EQ(defects.size(), 1u);
  EXPECT_THAT(defects[0], HasSubstr("reducer/from, stage fitted: gap at v = "));
  EXPECT_THAT(defects[0],
              HasSubstr("is 2e-08 mm by the first measurement, 3e-08 mm by the second; they may differ by "));
  EXPECT_FALSE(verified(result));
  EXPECT_EQ(exit_code_of(result, nullptr), exit_defect);
  const std::string table = run_table(result, nullptr, "j");
  EXPECT_THAT(table, HasSubstr("DEFECT OF THE PROGRAM"));
  EXPECT_THAT(table, HasSubstr("please report this with the job file"));
  EXPECT_THAT(table, HasSubstr(defects[0]));
  EXPECT_THAT(table, Not(HasSubstr("measured twice")));
}

TEST(SecondPathOfJobs, SeesAVerifierThatMeasuresAnotherSurface) {
  const JobResult result = reducer();
  const BlendResult& blend = result.blends[0];
  // The first path looks at a surface moved by a nanometre; the CAD kernel has the fitted one.
  std::vector<Vec3> control = blend.fit.surface.control();
  for (Vec3& p : control) p.z() += 1e-6;
  const BSplineSurface moved(blend.fit.surface.basis_u(), blend.fit.surface.basis_v(), control);
  BlendUnderTest wrong = under_test(blend, moved);
  EXPECT_THAT(disagreements(verify_blend(wrong, "fitted")), IsEmpty());
  wrong.second = under_test(blend, blend.fit.surface).second;
  EXPECT_THAT(disagreements(verify_blend(wrong, "fitted")), Not(IsEmpty()));
}

TEST(SecondPathOfJobs, IsInTheReportAndItsSchema) {
  JobResult result = reducer();
  const MiniSchema schema(report_schema());
  const auto report = [&] { return parse_json(report_json(result, nullptr, false)); };
  EXPECT_THAT(schema.violations(report()), IsEmpty());
  EXPECT_TRUE(report().find("defects")->items()->empty());
  result.blends[0].stages[0].second->seams[1].angle.difference = 1.0;
  const JsonValue wrong = report();
  EXPECT_EQ(wrong.find("defects")->items()->size(), 1u);
  EXPECT_FALSE(*wrong.find("verified")->boolean());
  const JsonValue& stage = wrong.find("blends")->items()->front().find("stages")->items()->front();
  EXPECT_FALSE(*stage.find("second_path")->find("to")->find("angle_deg")->find("agrees")->boolean());
  EXPECT_TRUE(*stage.find("second_path")->find("from")->find("angle_deg")->find("agrees")->boolean());
}

}  // namespace
}  // namespace blendwright::test
