// The checks trust nobody: an exported blend with one known defect is found out, whoever made it, and by the
// figure that the defect has.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "kernel/geometry/curvature.hpp"
#include "kernel/geometry/spline_interpolation.hpp"
#include "tests/app/job_support.hpp"

namespace blendwright {
namespace {

using test::example_job;

const JobResult& sound() {
  static const JobResult result = [] {
    JobSpec job = example_job("branch-to-main");
    job.output.formats = {OutputFormat::step};
    return run_job(job);
  }();
  return result;
}
const BSplineSurface& sound_surface() { return sound().blends[0].fit.surface; }

/// The control row that the k-th derivative across the edge depends on and lower ones do not.
int row_of(const BSplineSurface& s, int side, int k) { return side == 0 ? k : s.basis_u().count() - 1 - k; }

/// d^k/du^k at the edge per unit of row k.
double weight_of(const BSplineSurface& s, int side, int k) {
  const auto local = s.basis_u().evaluate(static_cast<double>(side), k);
  const auto i = static_cast<std::size_t>(row_of(s, side, k) - local.first);
  return local.value[static_cast<std::size_t>(k)][i];
}

BSplineSurface with_control(const BSplineSurface& s, int row, const std::vector<Vec3>& offsets) {
  std::vector<Vec3> control = s.control();
  for (std::size_t j = 0; j < offsets.size(); ++j)
    control[static_cast<std::size_t>(row) * offsets.size() + j] += offsets[j];
  return {s.basis_u(), s.basis_v(), std::move(control)};
}

/// The k-th derivative across the edge raised by size(jet) along the normal, at every v; lower ones stay.
template <class Size>
BSplineSurface bent(const BSplineSurface& s, int side, int k, Size size) {
  const std::vector<double>& breaks = s.basis_v().breaks();
  const auto n = static_cast<Eigen::Index>(breaks.size()) - 1;
  Eigen::MatrixXd change(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const SurfaceJet jet = s.jet({static_cast<double>(side), breaks[static_cast<std::size_t>(i)]});
    change.row(i) = size(jet) / weight_of(s, side, k) * unit_normal(jet).transpose();
  }
  const Eigen::MatrixXd control = periodic_control(s.basis_v(), change);
  std::vector<Vec3> offsets;
  for (Eigen::Index j = 0; j < control.rows(); ++j) offsets.emplace_back(control.row(j).transpose());
  return with_control(s, row_of(s, side, k), offsets);
}

/// The result as if the program had exported `surface`.
JobResult exported(const BSplineSurface& surface) {
  JobResult result = sound();
  BlendResult& blend = result.blends[0];
  blend.fit.surface = surface;
  blend.stages.back() = verify_blend(under_test(blend, surface), "fitted");
  return result;
}

/// Checks that fail at the seam of a side, at the last stage.
std::set<std::string> failed_at(const JobResult& result, std::size_t side) {
  const BlendReport& report = result.blends[0].stages.back();
  std::set<std::string> checks;
  for (const Finding& f : judge(report, {Continuity::G2, Continuity::G2}, result.job.tolerance))
    if (f.failed && f.text.rfind(report.seams[side].name + ":", 0) == 0) checks.insert(f.check);
  return checks;
}

const SeamReport& seam(const JobResult& result, std::size_t side) {
  return result.blends[0].stages.back().seams[side];
}

using Names = std::set<std::string>;

class Mutants : public ::testing::TestWithParam<int> {
 protected:
  int side_ = GetParam();
  std::size_t here_ = static_cast<std::size_t>(side_), there_ = 1 - here_;
  /// The mutant fails, and not because of its other side.
  void expect_rejected(const JobResult& result) const {
    EXPECT_FALSE(verified(result));
    EXPECT_EQ(failed_at(result, there_), Names{});
  }
};

TEST(Mutant, OfNothingPasses) {
  const JobResult result = exported(sound_surface());
  EXPECT_TRUE(verified(result));
  for (const std::size_t side : {0u, 1u}) EXPECT_EQ(failed_at(result, side), Names{});
}

TEST_P(Mutants, WithADentInTheEdgeHaveAGap) {
  const BSplineSurface& s = sound_surface();
  constexpr double depth = 1e-4;
  const auto j = static_cast<std::size_t>(s.basis_v().count()) / 3;
  const double v = s.basis_v().greville()[j];
  std::vector<Vec3> offsets(static_cast<std::size_t>(s.basis_v().count()), Vec3::Zero());
  offsets[j] = depth * unit_normal(s.jet({static_cast<double>(side_), v}));
  const JobResult result = exported(with_control(s, row_of(s, side_, 0), offsets));
  expect_rejected(result);
  EXPECT_TRUE(failed_at(result, here_).count("gap"));
  // The edge moves by depth N_j(v); besides, the sound blend may be off by the tolerance.
  double peak = 0.0;
  for (int i = 0; i <= 2000; ++i) {
    const auto local = s.basis_v().evaluate(s.domain().v.at(i / 2000.0), 0);
    for (int k = 0; k <= s.basis_v().degree(); ++k)
      if (s.basis_v().index(local.first + k) == static_cast<int>(j))
        peak = std::max(peak, local.value[0][static_cast<std::size_t>(k)]);
  }
  EXPECT_NEAR(seam(result, here_).gap.worst, depth * peak, result.job.tolerance.position);
  const std::vector<double>& breaks = s.basis_v().breaks();
  EXPECT_NEAR(seam(result, here_).gap.v, v, s.domain().v.length() / static_cast<double>(breaks.size() - 1));
}

/// The cross derivative turns by 0.1 deg about the trimline, to which it is perpendicular.
TEST_P(Mutants, TiltedByATenthOfADegreeHaveThatAngle) {
  const auto tilt = [](const SurfaceJet& jet) { return std::tan(degrees(0.1).value) * jet.Su.norm(); };
  const JobResult result = exported(bent(sound_surface(), side_, 1, tilt));
  expect_rejected(result);
  const Names failed = failed_at(result, here_);
  EXPECT_TRUE(failed.count("angle"));
  EXPECT_FALSE(failed.count("gap"));
  // The tilt is a quintic spline between its places, which errs by less than 1e-3 of it; the sound blend is
  // off by less than 1e-3 deg.
  EXPECT_NEAR(Radians(seam(result, here_).angle.worst).degrees(), 0.1, 2e-3);
}

/// The normal curvature across the trimline is (Suu.n)/|Su|^2.
TEST_P(Mutants, BentAcrossTheEdgeHaveACurvatureJumpAlone) {
  constexpr double jump = 1e-3;  // ten times the tolerance
  const auto bend = [](const SurfaceJet& jet) { return jump * jet.Su.squaredNorm(); };
  const JobResult result = exported(bent(sound_surface(), side_, 2, bend));
  expect_rejected(result);
  EXPECT_EQ(failed_at(result, here_), Names{"curvature jump"});
  EXPECT_NEAR(seam(result, here_).curvature.worst, jump, result.job.tolerance.curvature);
  // A joint that is asked G1 only is none the worse for it.
  EXPECT_EQ(
      judge(result.blends[0].stages.back(), {Continuity::G1, Continuity::G1}, result.job.tolerance).size(),
      judge(sound().blends[0].stages.back(), {Continuity::G1, Continuity::G1}, result.job.tolerance).size());
}

/// What is judged in the end is the file.
TEST_P(Mutants, AreFoundOutInTheStepFileToo) {
  const auto tilt = [](const SurfaceJet& jet) { return std::tan(degrees(0.1).value) * jet.Su.norm(); };
  JobResult result = exported(bent(sound_surface(), side_, 1, tilt));
  const test::TemporaryFolder folder("mutant-" + std::to_string(side_));
  const JobOutputs outputs = write_outputs(result, {.folder = folder.path()});
  ASSERT_EQ(result.blends[0].stages.back().stage, "step");
  EXPECT_FALSE(verified(result, &outputs));
  EXPECT_TRUE(failed_at(result, here_).count("angle"));
  EXPECT_EQ(failed_at(result, there_), Names{});
}

INSTANTIATE_TEST_SUITE_P(BothSides, Mutants, ::testing::Values(0, 1),
                         [](const auto& p) { return p.param == 0 ? "from" : "to"; });

}  // namespace
}  // namespace blendwright
