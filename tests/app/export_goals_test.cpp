// What a user receives: the exported B-spline and the STEP file read back keep the promised figures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "kernel/base/parallel_for.hpp"
#include "kernel/base/text_file.hpp"
#include "tests/app/job_support.hpp"

namespace blendwright {
namespace {

using test::example_job;

struct Goal {
  const char* job;
  bool
      second_order;  ///< taken from the primaries with G2 asked on both sides; else the job as it stands (G1)
};

class ExportGoal : public ::testing::TestWithParam<Goal> {};

void expect_goal(const BlendReport& report, const Goal& goal) {
  for (const SeamReport& seam : report.seams) {
    SCOPED_TRACE(report.stage + " " + seam.name);
    EXPECT_GT(seam.samples, 2000u);
    EXPECT_LE(seam.gap.worst, 1e-6);
    EXPECT_LE(seam.surface_gap.worst, 1e-6);
    EXPECT_LE(Radians(seam.angle.worst).degrees(), 1e-3);
    if (goal.second_order) {
      EXPECT_LE(seam.curvature.worst, 1e-4);
    }
  }
  if (!report.closing) return;
  EXPECT_LE(report.closing->gap, 1e-6);
  EXPECT_LE(report.closing->angle.degrees(), 1e-3);
  EXPECT_LE(report.closing->curvature, 1e-4);
}

TEST_P(ExportGoal, HoldsForTheFitAndForTheStepFileReadBack) {
  const Goal goal = GetParam();
  JobSpec job = example_job(goal.job);
  if (goal.second_order) job = test::from_primaries(job, Continuity::G2);
  job.output.formats = {OutputFormat::step};
  JobResult result = run_job(job);
  const test::TemporaryFolder folder(std::string("goal-") + goal.job + (goal.second_order ? "-g2" : "-g1"));
  const JobOutputs outputs = write_outputs(result, {.folder = folder.path()});
  const BlendResult& blend = result.blends.at(0);
  ASSERT_EQ(blend.stages.size(), 3u);
  expect_goal(blend.stages[1], goal);
  expect_goal(blend.stages[2], goal);
  EXPECT_LE(blend.fit.report.control_points, 2000);

  ASSERT_TRUE(outputs.step.has_value());
  const StepContent& step = *outputs.step;
  EXPECT_LE(step.bytes, 200u * 1000u);
  EXPECT_TRUE(step.check.valid);
  EXPECT_LE(step.check.largest_tolerance, 1e-6);
  EXPECT_LE(step.check.largest_edge_gap, 1e-6);
  EXPECT_EQ(step.check.unexpected_free_edges, 0u);
  EXPECT_EQ(step.check.shells, 1u);
  std::size_t faces = 0;
  for (const StepFace& face : step.faces) faces += face.name == blend.entry.name ? 1 : 0;
  EXPECT_EQ(faces, 1u);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, ExportGoal,
    ::testing::Values(Goal{"fig2-eq9", false}, Goal{"fig3-eq10", false}, Goal{"fig4-eq11", false},
                      Goal{"fig6-eq13", false}, Goal{"fig7-eq14", false}, Goal{"fig5-eq12", false},
                      Goal{"coaxial-cylinders", false}, Goal{"fig2-eq9", true}, Goal{"fig3-eq10", true},
                      Goal{"fig4-eq11", true}, Goal{"fig6-eq13", true}, Goal{"fig7-eq14", true},
                      Goal{"fig5-eq12", true}, Goal{"coaxial-cylinders", true}),
    [](const auto& p) {
      std::string name = std::string(p.param.job) + (p.param.second_order ? "_G2" : "_G1");
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

TEST(Export, OfStiffBlendsReadsBackAsTheyAre) {
  // 4259 is where exp(q/6) overflows; at 1e7 the thinnest knot span is 2e-8.
  for (const double q : {2500.0, 4300.0, 6000.0, 1e7}) {
    SCOPED_TRACE(q);
    JobSpec job = example_job("coaxial-cylinders");
    for (BlendSideEntry& side : job.blends.at(0).sides) side.side.continuity = Continuity::G1;
    job.blends.at(0).shape.repeated_root = q;
    job.output.formats = {OutputFormat::step};
    JobResult result = run_job(job);
    const test::TemporaryFolder folder("stiff");
    const JobOutputs outputs = write_outputs(result, {.folder = folder.path()});
    ASSERT_EQ(result.blends.at(0).stages.size(), 3u);
    expect_goal(result.blends.at(0).stages[2], {"coaxial-cylinders", false});
    ASSERT_TRUE(outputs.step.has_value());
    EXPECT_TRUE(outputs.step->check.valid);
  }
  JobSpec job = example_job("coaxial-cylinders");
  for (BlendSideEntry& side : job.blends.at(0).sides) side.side.continuity = Continuity::G1;
  job.blends.at(0).shape.repeated_root = 2e9;
  EXPECT_THROW((void)run_job(job), GeometryError);
}

TEST(Outputs, AreTheSameBytesOnAnyNumberOfThreads) {
  ::setenv("SOURCE_DATE_EPOCH", "1700000000", 1);
  std::vector<std::string> first;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    JobSpec job = example_job("branch-to-main");
    job.output.formats = {OutputFormat::step, OutputFormat::vtp, OutputFormat::stl, OutputFormat::obj};
    JobResult result = run_job(job);
    const test::TemporaryFolder folder("threads-" + std::to_string(threads));
    const JobOutputs outputs = write_outputs(result, {.folder = folder.path()});
    std::vector<std::string> texts;
    for (const WrittenFile& file : outputs.files)
      if (file.kind != "report") texts.push_back(read_text_file(file.path, 100'000'000));
    texts.push_back(report_json(result, nullptr, false));
    if (first.empty()) first = texts;
    ASSERT_GE(texts.size(), 6u);
    EXPECT_EQ(texts, first);
  }
  ::unsetenv("SOURCE_DATE_EPOCH");
}

TEST(Outputs, AreNotOverwrittenUnlessAsked) {
  JobSpec job = example_job("coaxial-cylinders");
  job.output.formats = {OutputFormat::stl};
  JobResult result = run_job(job);
  const test::TemporaryFolder folder("overwrite");
  const JobOutputs first = write_outputs(result, {.folder = folder.path()});
  ASSERT_GE(first.files.size(), 2u);
  EXPECT_THROW((void)write_outputs(result, {.folder = folder.path()}), IoError);
  EXPECT_NO_THROW((void)write_outputs(result, {.folder = folder.path(), .overwrite = true}));
}

}  // namespace
}  // namespace blendwright
