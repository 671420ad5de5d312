// Trimlines moved by hand, here and smoothly around or as a whole, whatever describes them.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "kernel/geometry/project.hpp"
#include "opened_session.hpp"

namespace blendwright {
namespace {

using test::handle;
using test::opened;
using Kind = SessionHandle::Kind;
using Reach = SessionHandle::Reach;

const TrimlineSpec& line_spec(const BlendSession& s, std::size_t side) {
  return *s.job().blends[0].sides[side].trimline;
}

/// A place of the primary a little beside the handle, on the side of `off`.
Vec3 beside(const BlendSession& s, const SessionHandle& h, const Vec3& off) {
  const Surface& primary = s.blend(0).trimlines[h.side]->primary();
  const double step = 0.02 * test::size_of(s.grid(0));
  const Vec3 target = h.position + step * off.normalized();
  const Foot foot = closest_point(primary, target);
  const SurfaceJet at = primary.jet(foot.at);
  return at.S;
}

struct LineCase {
  const char* job;
  std::size_t side;
  TrimlineSpec::Kind kind;
};

class LineHandles : public testing::TestWithParam<LineCase> {};

TEST_P(LineHandles, TheLineGoesWhereItsHandleIsPutAndStaysElsewhere) {
  const auto [job, side, kind] = GetParam();
  BlendSession s = opened(job);
  ASSERT_EQ(line_spec(s, side).kind, kind);
  std::vector<SessionHandle> before;
  for (std::size_t i = 0; i < 8; ++i) before.push_back(handle(s, Kind::trimline, side, i));
  SessionHandle h = before[3];
  h.reach = Reach::here;
  const Vec3 target = beside(s, h, Vec3(0.3, -0.5, -0.4));
  ASSERT_GT((target - h.position).norm(), 1e-3 * test::size_of(s.grid(0)));
  const BlendSession::Outcome outcome = s.drag(h, target);
  ASSERT_TRUE(outcome.done) << outcome.message;
  const double size = test::size_of(s.grid(0)), moved = (target - h.position).norm();
  const auto now = [&](std::size_t i) { return handle(s, Kind::trimline, side, i).position; };
  // The foot of a point that is on the surface is the point.
  EXPECT_LE((now(3) - target).norm(), 1e-9 * size);
  for (const std::size_t far : {0, 7, 6}) EXPECT_LE((now(far) - before[far].position).norm(), 1e-9 * size);
  for (const std::size_t near : {2, 4}) {  // 26 / 66 of a B-spline of degree 5, on a curved primary
    EXPECT_GT((now(near) - before[near].position).norm(), 0.2 * moved);
    EXPECT_LT((now(near) - before[near].position).norm(), 0.6 * moved);
  }
  EXPECT_LE(s.errors(0).gap, 1e-12 * std::max(1.0, test::size_of(s.grid(0))));
  EXPECT_EQ(line_spec(s, side).kind, kind);
  const std::string text = s.saved_text();
  EXPECT_NE(text.find("\"shift\""), std::string::npos);
  EXPECT_TRUE(test::same_grid(opened(job, text).grid(0), s.grid(0)));
  ASSERT_TRUE(s.undo());
  EXPECT_EQ(s.saved_text(), test::example_text(job));
}

TEST_P(LineHandles, TheWholeLineFollowsOnRequest) {
  const auto [job, side, kind] = GetParam();
  BlendSession s = opened(job);
  const SessionHandle h = handle(s, Kind::trimline, side, 3);
  const Vec3 target = beside(s, h, Vec3(0.3, -0.5, -0.4));
  const BlendSession::Outcome outcome = s.drag(h, target);
  ASSERT_TRUE(outcome.done) << outcome.message;
  if (kind == TrimlineSpec::Kind::isoline) {
    EXPECT_TRUE(line_spec(s, side).shift.empty());
    EXPECT_NE(s.saved_text(), test::example_text(job));
  } else {
    EXPECT_EQ(line_spec(s, side).shift.size(), 1U);
  }
  std::size_t moved = 0;
  const BlendSession first = opened(job);
  for (std::size_t i = 0; i < 8; ++i)
    moved += (handle(s, Kind::trimline, side, i).position - handle(first, Kind::trimline, side, i).position)
                 .norm() > 1e-4 * test::size_of(s.grid(0));
  EXPECT_EQ(moved, 8U);
}

std::string kind_name(const testing::TestParamInfo<LineCase>& info) {
  constexpr std::array<const char*, 5> names{"Isoline", "Parameters", "Projected", "Edge", "EdgeChain"};
  return names[static_cast<std::size_t>(info.param.kind)];
}

INSTANTIATE_TEST_SUITE_P(Examples, LineHandles,
                         testing::Values(LineCase{"varying-magnitude", 0, TrimlineSpec::Kind::isoline},
                                         LineCase{"leaning-cylinder", 1, TrimlineSpec::Kind::parameters},
                                         LineCase{"branch-to-main", 1, TrimlineSpec::Kind::projected},
                                         LineCase{"step-transition", 0, TrimlineSpec::Kind::edge}),
                         kind_name);

TEST(LineHandle, AnEndOnTheBorderOfThePrimaryStaysOnIt) {
  BlendSession s = opened("open-blend");
  SessionHandle h = handle(s, Kind::trimline, 0, 0);
  h.reach = Reach::here;
  const Surface panel = s.blend(0).trimlines[0]->primary();
  ASSERT_TRUE(s.drag(h, panel.jet({-0.4, -2.8}).S).done);
  const Vec2 end = s.blend(0).trimlines[0]->pcurve().point(s.blend(0).trimlines[0]->domain().v.lo);
  EXPECT_NEAR(end[0], -0.4, 1e-7);
  EXPECT_EQ(end[1], -3.0);
}

TEST(LineHandle, AShiftOfTheJobGivesTheHandlesTheirPlaces) {
  std::string text = test::example_text("varying-magnitude");
  const std::size_t at = text.find("\"isoline\"");
  text.insert(at + 9, ", \"shift\": [[0.1, -0.1, 0], [0.4, -0.15, 0], [0.6, -0.1, 0.01]]");
  BlendSession s = opened("varying-magnitude", text);
  SessionHandle h = handle(s, Kind::trimline, 0, 1);
  EXPECT_THROW((void)handle(s, Kind::trimline, 0, 3), std::out_of_range);
  h.reach = Reach::here;
  ASSERT_TRUE(s.drag(h, beside(s, h, Vec3(0.1, 0.2, -1.0))).done);
  ASSERT_EQ(line_spec(s, 0).shift.size(), 3U);
  const Vec2 step = line_spec(s, 0).shift[1].by - Vec2(-0.15, 0.0);
  EXPECT_GT(step.norm(), 0.01);
  // Neighbours at least a step of the shift away follow by 26 / 66 at most.
  EXPECT_LE((line_spec(s, 0).shift[0].by - Vec2(-0.1, 0.0)).norm(), 0.4 * step.norm());
}

}  // namespace
}  // namespace blendwright
