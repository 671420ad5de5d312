#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "tests/verify/judged.hpp"

namespace blendwright {
namespace {

using namespace test;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Judge, SoundBlendPassesWithANoteOnItsRadius) {
  const BlendReport report = verify_blend(between_cylinders(continued_cylinder()), "formula");
  EXPECT_EQ(report.stage, "formula");
  EXPECT_EQ(reached(report.seams[0], Tolerance{}), Continuity::G2);
  EXPECT_EQ(reached(report.seams[1], Tolerance{}), Continuity::G2);
  ASSERT_TRUE(report.closing);
  const std::vector<Finding> found = judge(report, g2, Tolerance{});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].check, "minimum radius");
  EXPECT_FALSE(found[0].failed);
  EXPECT_THAT(found[0].text, StartsWith("pipe: minimum radius 1 mm at u = "));
}

TEST(Judge, TableNamesAreUniqueAndEveryFindingIsInIt) {
  const std::vector<CheckInfo> table = checks_table();
  std::set<std::string_view> names;
  for (const CheckInfo& row : table) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_FALSE(row.description.empty());
  }
  const auto messy = pipe([](const auto& u) { return 0.1 + 0.3 * u; });
  for (const Finding& f : failures(between_cylinders(messy))) EXPECT_TRUE(names.contains(f.check)) << f.check;
}

TEST(Judge, ShiftFailsTheGap) {
  const auto blend = between_cylinders(pipe([](const auto& u) { return 1e-4 + 0.0 * u; }));
  EXPECT_EQ(failed_checks(blend), Names{"gap"});
  EXPECT_THAT(failures(blend)[0].text, StartsWith("pipe/from: gap 0.0001 mm exceeds 1e-06 mm at v = "));
  EXPECT_EQ(failed_checks(blend, {Continuity::none, Continuity::none}), Names{});
}

TEST(Judge, TiltFailsTheAngle) {
  // Tilted by 0.1 deg at the lower end; the radius returns to 1 at the upper one, flat to second order.
  const double slope = 2.0 * std::tan(degrees(0.1).value);
  const auto blend = between_cylinders(pipe([slope](const auto& u) {
    const auto w = 1.0 - u;
    return slope * u * w * w * w * (1.0 + 3.0 * u);
  }));
  EXPECT_EQ(failed_checks(blend, {Continuity::G1, Continuity::G2}), Names{"angle"});
  EXPECT_THAT(failures(blend)[0].text, StartsWith("pipe/from: angle 0.1 deg exceeds 0.001 deg at v = "));
  EXPECT_EQ(failed_checks(blend, {Continuity::G0, Continuity::G2}), Names{});
}

TEST(Judge, CurvatureChangeFailsTheCurvatureJump) {
  // r = 1 + a u^2 (1-u)^3, z' = 2: the meridian bends by 2a/4 at the lower end.
  const auto blend = between_cylinders(pipe([](const auto& u) {
    const auto w = 1.0 - u;
    return 0.02 * u * u * w * w * w;
  }));
  EXPECT_EQ(failed_checks(blend), Names{"curvature jump"});
  EXPECT_THAT(failures(blend)[0].text,
              StartsWith("pipe/from: curvature jump 0.01 1/mm exceeds 0.0001 1/mm at v = "));
  EXPECT_EQ(failed_checks(blend, {Continuity::G1, Continuity::G2}), Names{});
}

TEST(Judge, FlippedDirectionFailsTheFold) {
  const auto down = revolution(
      turn, [](const auto&) { return 1.0; }, [](const auto& u) { return 1.0 - 0.5 * u; });
  auto blend = between_cylinders(down);
  blend.seams[1].primary.reset();
  EXPECT_EQ(failed_checks(blend), Names{"fold"});
  EXPECT_THAT(failures(blend)[0].text,
              HasSubstr("folds back over the kept part of the primary on 2048 of 2048 samples"));
  EXPECT_EQ(failed_checks(blend, {Continuity::G0, Continuity::G0}), Names{});
}

TEST(Judge, CreaseFailsTheFold) {
  // z goes up, back and up again, the radius stays: the normal turns over twice (and the sheets cover each
  // other).
  const auto creased = revolution(
      turn, [](const auto&) { return 1.0; },
      [](const auto& u) { return 1.0 + 2.0 * u + 0.6 * sin(2.0 * pi * u); });
  EXPECT_TRUE(failed_checks(between_cylinders(creased)).contains("fold"));
}

TEST(Judge, UnjudgedPenetrationIsANote) {
  BlendReport report = verify_blend(between_cylinders(continued_cylinder()), "formula");
  report.penetration[1] = PenetrationReport{false, {}};
  const std::vector<Finding> found = judge(report, g2, Tolerance{});
  const auto note =
      std::find_if(found.begin(), found.end(), [](const Finding& f) { return f.check == "penetration"; });
  ASSERT_NE(note, found.end());
  EXPECT_FALSE(note->failed);
}

TEST(Judge, NotANumberFailsWhateverIsAsked) {
  const auto broken = pipe([](const auto& u) { return 0.0 * sqrt(0.9 - u); });
  EXPECT_FALSE(failures(between_cylinders(broken), {Continuity::none, Continuity::none}).empty());
  const BlendReport sound = verify_blend(between_cylinders(continued_cylinder()), "formula");
  const std::array<Continuity, 2> nothing{Continuity::none, Continuity::none};
  const auto fails = [&](auto&& spoil) {
    BlendReport report = sound;
    spoil(report);
    const std::vector<Finding> found = judge(report, nothing, Tolerance{});
    return std::any_of(found.begin(), found.end(), [](const Finding& f) { return f.failed; });
  };
  EXPECT_FALSE(fails([](BlendReport&) {}));
  EXPECT_TRUE(fails([](BlendReport& r) { r.seams[1].gap.worst = nan; }));
  EXPECT_TRUE(fails([](BlendReport& r) { r.seams[0].surface_gap.worst = nan; }));
  EXPECT_TRUE(fails([](BlendReport& r) { r.seams[0].angle.worst = nan; }));
  EXPECT_TRUE(fails([](BlendReport& r) { r.seams[0].curvature.worst = nan; }));
  EXPECT_TRUE(fails([](BlendReport& r) { r.seams[0].transverse.worst = nan; }));
  EXPECT_TRUE(fails([](BlendReport& r) { r.seams[0].fold.worst = nan; }));
  EXPECT_TRUE(fails([](BlendReport& r) { r.closing->gap = nan; }));
  EXPECT_TRUE(fails([](BlendReport& r) { r.closing->angle = Radians(nan); }));
  EXPECT_TRUE(fails([](BlendReport& r) { r.closing->curvature = nan; }));
  EXPECT_TRUE(fails([](BlendReport& r) { r.fold.smallest_area.value = nan; }));
  EXPECT_TRUE(fails([](BlendReport& r) { r.minimum_radius.value = nan; }));
  EXPECT_TRUE(fails([](BlendReport& r) { r.penetration[0]->depth.value = nan; }));
  EXPECT_TRUE(fails([](BlendReport& r) { r.self_intersection.where.value = nan; }));
}

TEST(Judge, NoSamplesFail) {
  VerifyOptions options;
  options.seam.samples = 0;
  const BlendReport report = verify_blend(between_cylinders(continued_cylinder()), "formula", options);
  EXPECT_TRUE(judge(report, g2, Tolerance{}).front().failed);
}

TEST(Judge, SideWithoutPrimaryIsANote) {
  auto blend = between_cylinders(continued_cylinder());
  blend.seams[0].primary.reset();
  const std::vector<Finding> found = judge(verify_blend(blend, "formula"), g2, Tolerance{});
  EXPECT_EQ(found.front().check, "gap");
  EXPECT_FALSE(found.front().failed);
  EXPECT_THAT(found.front().text, HasSubstr("no primary"));
}

TEST(Judge, UnitIsWritten) {
  const BlendReport report = verify_blend(between_cylinders(continued_cylinder()), "formula");
  EXPECT_THAT(judge(report, g2, Tolerance{}, LengthUnit::inch).back().text,
              HasSubstr("minimum radius 1 in at"));
}

TEST(VerifyBlend, ReportsMonotoneProgress) {
  Progress progress;
  std::vector<double> fractions;
  progress.report = [&](double f, std::string_view) { fractions.push_back(f); };
  (void)verify_blend(between_cylinders(continued_cylinder()), "fitted", {}, progress);
  ASSERT_FALSE(fractions.empty());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1.0);
}

}  // namespace
}  // namespace blendwright
