#include <gtest/gtest.h>

#include "kernel/base/error.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/geometry/curvature.hpp"
#include "opened_session.hpp"

namespace blendwright {
namespace {

using test::control;
using test::opened;
using test::same_grid;

UV place(const BlendSession& s, std::size_t i, std::size_t j) {
  const SessionGrid& g = s.grid(0);
  const Interval v = s.blend(0).surface.domain().v;
  return {static_cast<double>(i) / static_cast<double>(g.nu - 1),
          v.at(static_cast<double>(j) / static_cast<double>(g.nv - 1))};
}
Vec3 triple(const std::vector<float>& all, std::size_t k) {
  return {all[3 * k], all[3 * k + 1], all[3 * k + 2]};
}

// A float has 24 bits: rounding a coordinate of at most `size` costs 2^-24 size, of a unit normal 2^-24; the
// exact sums differ by far less. Three coordinates: sqrt(3) times that, 2 for the bit that size may miss.
constexpr double float_rounding = 2.0 * 1.8 / (1 << 24);

void expect_surface(const BlendSession& s, const std::string& what) {
  const SessionGrid& g = s.grid(0);
  const double size = test::size_of(g);
  for (std::size_t i = 0; i < g.nu; ++i)
    for (std::size_t j = 0; j < g.nv; ++j) {
      const std::size_t k = i * g.nv + j;
      const SurfaceJet jet = s.blend(0).surface.jet(place(s, i, j));
      ASSERT_LE((g.origin + triple(g.positions, k) - jet.S).norm(), float_rounding * size) << what;
      ASSERT_LE((triple(g.normals, k) - unit_normal(jet)).norm(), float_rounding) << what;
    }
}

TEST(BlendSession, ShowsTheSurfaceInEveryModeOrderAndFrame) {
  for (const char* name : {"coaxial-cylinders", "leaning-cylinder", "fig2-eq9", "open-blend"}) {
    BlendSession s = opened(name);
    expect_surface(s, name);
    for (const double mode : {1.0, 2.0, 0.0}) {
      ASSERT_TRUE(s.set(control(s, "mode"), mode).done);
      expect_surface(s, std::string(name).append(" in another mode"));
    }
    if (s.job().blends[0].literal()) continue;
    ASSERT_TRUE(s.set(control(s, "continuity from"), 2.0).done);
    EXPECT_EQ(s.blend(0).surface.order(), 6);
    expect_surface(s, std::string(name).append(" of sixth order"));
  }
}

TEST(BlendSession, TurnsWithFixedAndMovingFrames) {
  JobSpec job = read_job_file(test::example_file("open-blend"));
  BlendShape& shape = job.blends[0].shape;
  for (BlendSideEntry& side : job.blends[0].sides) side.side.continuity = Continuity::G1;
  shape.ode = {SweepOde::tension(1.0), SweepOde::tension(4.0), SweepOde::tension(9.0)};
  for (const BlendFrame frame : {BlendFrame::fixed, BlendFrame::moving}) {
    shape.frame = frame;
    shape.axes.col(0) = Vec3(0.6, 0.8, 0.0);
    shape.axes.col(1) = Vec3(-0.8, 0.6, 0.0);
    expect_surface(BlendSession(test::example_text("open-blend"), job, 24, 24), name(frame));
  }
}

TEST(BlendSession, NormalsAgreeWithFiniteDifferences) {
  BlendSession s = opened("open-blend");
  const SessionGrid& g = s.grid(0);
  const double h = 1e-5;  // central differences: error h^2 = 1e-10 of the bend, rounding 1e-16 / h = 1e-11
  for (std::size_t i = 1; i + 1 < g.nu; ++i)
    for (std::size_t j = 1; j + 1 < g.nv; ++j) {
      const UV at = place(s, i, j);
      const auto S = [&](double u, double v) { return s.blend(0).surface.jet({u, v}).S; };
      const Vec3 n = (S(at.u + h, at.v) - S(at.u - h, at.v)).cross(S(at.u, at.v + h) - S(at.u, at.v - h));
      ASSERT_LE((triple(g.normals, i * g.nv + j) - n.normalized()).norm(), 1e-6);  // floats: 1e-7
    }
}

TEST(BlendSession, AGridIsTheSameBytesOnOneThread) {
  const BlendSession all = opened("open-blend", 64);
  const ThreadLimit one(1);
  EXPECT_TRUE(same_grid(all.grid(0), opened("open-blend", 64).grid(0)));
}

TEST(BlendSession, ValuesThatCannotBeLeaveEverythingAsItWas) {
  BlendSession s = opened("open-blend");
  const SessionGrid before = s.grid(0);
  const std::string text = s.saved_text();
  const BlendSession::Outcome nan = s.set(control(s, "tension"), std::nan(""));
  EXPECT_FALSE(nan.done);
  EXPECT_FALSE(nan.message.empty());
  for (SessionHandle h : s.handles()) {
    if (h.kind != SessionHandle::Kind::magnitude) continue;
    const SurfaceJet jet = s.blend(0).surface.jet({static_cast<double>(h.side), h.v});
    const BlendSession::Outcome back = s.drag(h, jet.S - (h.position - jet.S));
    EXPECT_FALSE(back.done);
    EXPECT_NE(back.message.find("positive"), std::string::npos);
  }
  EXPECT_FALSE(s.changed());
  EXPECT_TRUE(same_grid(before, s.grid(0)));
  EXPECT_EQ(text, s.saved_text());
}

TEST(BlendSession, MagnitudeHandlesFollowTheHand) {
  BlendSession s = opened("open-blend");
  const SessionHandle h = test::handle(s, SessionHandle::Kind::magnitude, 0, 3);
  const SurfaceJet jet = s.blend(0).surface.jet({static_cast<double>(h.side), h.v});
  const Vec3 target = jet.S + 1.5 * (h.position - jet.S);
  ASSERT_TRUE(s.drag(h, target).done);
  // The law is a spline through this handle's own value.
  EXPECT_LE((test::handle(s, SessionHandle::Kind::magnitude, 0, 3).position - target).norm(),
            1e-12 * (target - jet.S).norm() + 1e-12 * target.norm());
  EXPECT_TRUE(s.changed());
}

TEST(BlendSession, SwitchingToG2SaysWhatBecomesOfQ) {
  JobSpec job = read_job_file(test::example_file("open-blend"));
  for (BlendSideEntry& side : job.blends[0].sides) side.side.continuity = Continuity::G1;
  job.blends[0].shape.repeated_root = 2.0;
  job.blends[0].shape.frame = BlendFrame::global;
  BlendSession s(test::example_text("open-blend"), job, 8, 8);
  const BlendSession::Outcome outcome = s.set(control(s, "continuity to"), 2.0);
  ASSERT_TRUE(outcome.done) << outcome.message;
  EXPECT_NE(outcome.message.find("q = 2 becomes the tension"), std::string::npos) << outcome.message;
  EXPECT_EQ(s.job().blends[0].shape.tension, 2.0);
}

TEST(BlendSession, PickingShowsTheSurface) {
  const BlendSession s = opened("open-blend");
  const UV at{0.3, s.blend(0).surface.domain().v.at(0.6)};
  const PickedPoint p = s.picked(0, at);
  const SurfaceJet jet = s.blend(0).surface.jet(at);
  EXPECT_EQ(p.point, jet.S);
  EXPECT_EQ(p.normal, unit_normal(jet));
  EXPECT_EQ(*p.gaussian_curvature, curvature(jet).gaussian);
  EXPECT_EQ(p.object, s.job().blends[0].name);
  EXPECT_TRUE(p.gap && p.angle_deg && p.curvature_jump);
}

}  // namespace
}  // namespace blendwright
