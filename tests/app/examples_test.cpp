// Every example job runs and is judged as its page in the gallery says.
#include <gtest/gtest.h>

#include <map>

#include "tests/app/job_support.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;
using test::example_job;

/// Whether the job is verified. The printed variants of the paper's figures are not tangent, and the program
/// says so.
const std::map<std::string, bool> expected{
    {"branch-to-main", true},     {"coaxial-cylinders", true},  {"fig1a-eq8", false},
    {"fig1b-eq8", false},         {"fig1c-eq8", false},         {"fig2-eq9", true},
    {"fig2-eq9-literal", true},   {"fig3-eq10", true},          {"fig3-eq10-printed", false},
    {"fig4-eq11", true},          {"fig4-eq11-printed", false}, {"fig5-eq12", true},
    {"fig6-eq13", true},          {"fig6-eq13-printed", false}, {"fig7-eq14", true},
    {"fig7-eq14-printed", false}, {"leaning-cylinder", true},   {"open-blend", true},
    {"step-transition", true},    {"varying-magnitude", true},  {"fit-rolling-ball", true},
    {"fit-fairest", true},        {"fit-through-points", true}, {"fit-clearance", true},
    {"moved-trimline", true},
};

TEST(Examples, AreJudgedAsExpected) {
  std::size_t seen = 0;
  for (const auto& entry : fs::directory_iterator(test::specs_folder())) {
    if (entry.path().extension() != ".json") continue;
    const std::string name = entry.path().stem();
    SCOPED_TRACE(name);
    const auto row = expected.find(name);
    ASSERT_NE(row, expected.end()) << "the table in this test has no row for this example";
    ++seen;
    const JobResult result = run_job(example_job(name));
    EXPECT_EQ(verified(result), row->second);
  }
  EXPECT_EQ(seen, expected.size());
}

struct PrintedDefect {
  const char* job;
  std::size_t side;
  double degrees;  ///< golden: printed_tangent_max_normal_angle_deg, the largest of 48 places
};

class PrintedTangent : public ::testing::TestWithParam<PrintedDefect> {};

TEST_P(PrintedTangent, DefectIsMeasured) {
  const auto [job, side, expected_degrees] = GetParam();
  const JobResult result = run_job(example_job(job));
  const double measured = Radians(result.blends[0].stages[0].seams[side].angle.worst).degrees();
  // The golden value is the largest of 48 places, ours a refined maximum over all v: never smaller, and near
  // it.
  EXPECT_GE(measured, expected_degrees - 1e-6);
  EXPECT_LE(measured, expected_degrees + 0.2);
}

INSTANTIATE_TEST_SUITE_P(Figures, PrintedTangent,
                         ::testing::Values(PrintedDefect{"fig3-eq10-printed", 0, 89.82764283727956},
                                           PrintedDefect{"fig3-eq10-printed", 1, 54.30531225575434},
                                           PrintedDefect{"fig4-eq11-printed", 0, 6.327053351624233},
                                           PrintedDefect{"fig6-eq13-printed", 1, 5.1756314081396235},
                                           PrintedDefect{"fig7-eq14-printed", 1, 8.185819087909193}));

/// Formula sheet, section 8: in origin mode c = -30 pulls eq14 through the horizontal cylinder, chord mode
/// does not.
TEST(Penetration, OriginPullIsCaughtAndChordModePasses) {
  const auto penetrates = [](BlendMode mode) {
    JobSpec job = example_job("fig7-eq14");
    job.blends[0].shape.ode.fill({1.0, -30.0, 225.0});
    job.blends[0].shape.mode = mode;
    const JobResult result = run_job(job);
    for (const Finding& f :
         judge(result.blends[0].stages.back(), {Continuity::G1, Continuity::G1}, job.tolerance))
      if (f.check == "penetration" && f.failed) return true;
    return false;
  };
  EXPECT_TRUE(penetrates(BlendMode::origin));
  EXPECT_FALSE(penetrates(BlendMode::chord));
}

TEST(Examples, BoundaryDoesNotDependOnTheShapeParameters) {
  for (const char* name : {"fig3-eq10", "fig7-eq14"}) {
    std::optional<std::vector<Vec3>> first;
    for (const double c : {-3.0, -15.0, -30.0}) {
      JobSpec job = example_job(name);
      job.blends[0].shape.ode.fill({1.0, c, 0.25 * c * c});
      const JobResult result = run_job(job);
      std::vector<Vec3> values;
      for (int i = 0; i < 32; ++i)
        for (const double u : {0.0, 1.0}) {
          const SurfaceJet jet = result.blends[0].blend.surface.jet({u, 0.2 * i});
          values.push_back(jet.S);
          values.push_back(jet.Su);
        }
      if (!first) first = values;
      for (std::size_t k = 0; k < values.size(); ++k)  // golden criterion: identical to 1e-15 relative
        EXPECT_LE((values[k] - (*first)[k]).norm(), 1e-15 * (1.0 + values[k].norm()));
    }
  }
}

}  // namespace
}  // namespace blendwright
