// The error of a blend as a B-spline falls with its spans as theory says, measured where a user looks: at the
// seams, against the primaries.
//
// A spline of degree p through smooth data at spans of width h: position O(h^{p+1}), tangent plane O(h^p),
// because the derivative along the trimline loses one order. Source: de Boor, A Practical Guide to Splines,
// ch. XII.
#include <gtest/gtest.h>

#include <cmath>

#include "kernel/geometry/spline_interpolation.hpp"
#include "tests/app/job_support.hpp"

namespace blendwright {
namespace {

std::vector<double> uniform_breaks(const Interval& range, int spans) {
  std::vector<double> breaks;
  for (int i = 0; i <= spans; ++i) breaks.push_back(range.at(static_cast<double>(i) / spans));
  return breaks;
}

/// Eight quintic spans across, `spans` of the degree along.
BSplineSurface interpolated(const OdeBlend& blend, int degree, int spans) {
  const SurfaceDomain domain = blend.domain();
  const auto across = BSplineBasis::clamped(5, uniform_breaks(domain.u, 8));
  const auto breaks = uniform_breaks(domain.v, spans);
  return interpolate_surface(
      blend, across,
      domain.v_closed ? BSplineBasis::closed(degree, breaks) : BSplineBasis::clamped(degree, breaks));
}

/// G2 on both sides, on the parameters that the trimlines have by nature, whose derivatives of every order
/// are smooth. (Arc length is a spline map itself, with breaks of its own.)
JobSpec smooth_job(const char* name) {
  JobSpec job = test::from_primaries(test::example_job(name), Continuity::G2);
  job.blends[0].correspondence.rule = CorrespondenceRule::as_given;
  return job;
}

/// Orders by which a figure falls at each doubling of the spans.
struct Orders {
  std::vector<double> measured;
  double last = 0.0;  ///< the figure itself, after the last doubling

  /// `floor`: where rounding takes over.
  void add(double figure, double floor) {
    if (last > floor && figure > floor) measured.push_back(std::log2(last / figure));
    last = figure;
  }
};

struct SideOrders {
  Orders gap, angle;
};

/// From 64 spans on, where the leading term rules for these shapes, to 512. Gaps are measured against
/// positions up to 10 (rounding 1e-15), angles divide that by spans of 0.01 or more.
std::array<SideOrders, 2> study(const BlendResult& blend, int degree) {
  std::array<SideOrders, 2> orders;
  for (const int spans : {64, 128, 256, 512}) {
    const BlendUnderTest surfaces = under_test(blend, interpolated(blend.blend.surface, degree, spans));
    for (std::size_t side = 0; side < 2; ++side) {
      const SeamReport report = check_seam(surfaces.seams[side]);
      orders[side].gap.add(report.gap.worst, 1e-14);
      orders[side].angle.add(report.angle.worst, 1e-12);
    }
  }
  return orders;
}

void expect_order(const Orders& orders, double expected) {
  for (const double order : orders.measured) {
    EXPECT_GE(order, expected - 0.5);
    EXPECT_LE(order, expected + 0.5);
  }
}

constexpr std::array curved{"branch-to-main", "fig7-eq14"};

TEST(Refinement, QuinticGapFallsWithTheSixthPowerUntilRounding) {
  for (const char* name : curved) {
    SCOPED_TRACE(name);
    const JobResult result = run_job(smooth_job(name));
    for (const SideOrders& side : study(result.blends[0], 5)) {
      EXPECT_GE(side.gap.measured.size(), 1u);
      expect_order(side.gap, 6.0);
      EXPECT_LE(side.gap.last, 1e-13);
      EXPECT_GE(side.angle.measured.size(), 2u);
      expect_order(side.angle, 5.0);
    }
  }
}

TEST(Refinement, CubicGapFallsWithTheFourthPower) {
  for (const char* name : curved) {
    SCOPED_TRACE(name);
    const JobResult result = run_job(smooth_job(name));
    for (const SideOrders& side : study(result.blends[0], 3)) {
      EXPECT_EQ(side.gap.measured.size(), 3u);
      expect_order(side.gap, 4.0);
      EXPECT_GT(side.gap.last, 1e-12);
      EXPECT_EQ(side.angle.measured.size(), 3u);
      expect_order(side.angle, 3.0);
    }
  }
}

/// Complete interpolation at the ends loses nothing; the flat side, whose trimline is straight, is exact from
/// the start.
TEST(Refinement, OpenBlendsConvergeAsClosedOnes) {
  const JobResult result = run_job(smooth_job("open-blend"));
  for (const int degree : {3, 5}) {
    SCOPED_TRACE(degree);
    const auto [panel, flange] = study(result.blends[0], degree);
    EXPECT_GE(panel.gap.measured.size(), 1u);
    expect_order(panel.gap, degree + 1.0);
    EXPECT_GE(panel.angle.measured.size(), 1u);
    expect_order(panel.angle, degree);
    EXPECT_LE(flange.gap.last, 1e-14);
    EXPECT_LE(flange.angle.last, 1e-12);
  }
}

}  // namespace
}  // namespace blendwright
