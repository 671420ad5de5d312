#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <iostream>
#include <random>

#include "opened_session.hpp"

namespace blendwright {
namespace {

using test::control;
using test::opened;
using test::same_grid;

/// One gesture: any control or any handle, anywhere.
BlendSession::Outcome random_drag(BlendSession& s, std::mt19937_64& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const auto controls = s.controls();
  const auto handles = s.handles();
  const std::size_t k = random() % (controls.size() + handles.size() / 4 + 1);
  if (k < controls.size()) {
    const SessionControl& c = controls[k];
    return s.set(k, c.logarithmic ? c.low * std::pow(c.high / c.low, part(random))
                                  : c.low + (c.high - c.low) * part(random));
  }
  if (handles.empty()) return {};
  SessionHandle h = handles[random() % handles.size()];
  if (random() % 2 == 0) h.reach = SessionHandle::Reach::here;
  const double step = 0.1 * test::size_of(s.grid(h.blend));
  const Vec3 by(part(random) - 0.5, part(random) - 0.5, part(random) - 0.5);
  return s.drag(h, h.position + step * by);
}

std::array<Trimline, 2> lines_of(const BlendSession& s) {
  return {*s.blend(0).trimlines[0], *s.blend(0).trimlines[1]};
}

class Dragged : public testing::TestWithParam<const char*> {};

TEST_P(Dragged, BoundariesHoldHistoryReturnsAndTheTextIsTheShape) {
  std::mt19937_64 random(20261123);
  BlendSession s = opened(GetParam());
  const std::string first_text = s.saved_text();
  EXPECT_EQ(first_text, test::example_text(GetParam()));
  const SessionGrid first = s.grid(0);
  std::size_t done = 0;
  std::array<std::size_t, 2> moved{0, 0};  // trimlines that another place of the job says
  for (int i = 0; i < 200; ++i) {
    const SessionGrid before = s.grid(0);
    const std::array<Trimline, 2> lines = lines_of(s);
    const BlendSession::Outcome outcome = random_drag(s, random);
    const std::array<Trimline, 2> after = lines_of(s);
    for (std::size_t side = 0; side < 2; ++side)
      moved[side] += lines[side].jet(0.3).C() != after[side].jet(0.3).C();
    if (outcome.done) {
      ++done;
    } else {
      EXPECT_FALSE(outcome.message.empty());
      ASSERT_TRUE(same_grid(before, s.grid(0))) << outcome.message;
    }
    // The goal of the project: 1e-12 of the size; the floats of the grid hold it to 1e-7 of itself.
    ASSERT_LE(s.errors(0).gap, 1e-12 * std::max(1.0, test::size_of(s.grid(0)))) << i;
    s.commit();
  }
  EXPECT_GT(done, 100U);
  // Typed boundary data have no handles.
  for (const std::size_t count : moved) EXPECT_GE(count, s.handles().empty() ? 0U : 10U);
  const SessionGrid last = s.grid(0);
  EXPECT_FALSE(same_grid(first, last));
  const std::string last_text = s.saved_text();
  EXPECT_TRUE(s.changed());
  s.mark_saved();
  EXPECT_FALSE(s.changed());
  const BlendSession again = opened(GetParam(), last_text);
  EXPECT_TRUE(same_grid(again.grid(0), last));
  while (s.undo()) {
  }
  EXPECT_TRUE(same_grid(first, s.grid(0)));
  EXPECT_TRUE(s.changed());
  EXPECT_EQ(first_text, s.saved_text());
  while (s.redo()) {
  }
  EXPECT_TRUE(same_grid(last, s.grid(0)));
  EXPECT_EQ(last_text, s.saved_text());
}

INSTANTIATE_TEST_SUITE_P(Examples, Dragged,
                         testing::Values("open-blend", "varying-magnitude", "fig2-eq9", "branch-to-main",
                                         "leaning-cylinder", "step-transition"));

double rate(const std::function<void(int)>& reshape) {
  const auto start = std::chrono::steady_clock::now();
  const int count = 30;
  for (int i = 0; i < count; ++i) reshape(i);
  return count / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(BlendSession, PrintsReshapesPerSecond) {
  BlendSession s = opened("varying-magnitude", 200);
  const SessionGrid first = s.grid(0);
  std::cout << "reshapes per second of 200 x 200: tension "
            << rate([&](int i) { EXPECT_TRUE(s.set(control(s, "tension"), 1.0 + 0.1 * i).done); })
            << ", magnitude "
            << rate([&](int i) { EXPECT_TRUE(s.set(control(s, "magnitude from"), 0.7 + 0.01 * i).done); })
            << "\n";
  EXPECT_FALSE(same_grid(first, s.grid(0)));
}

TEST(BlendSession, TrimlinesFollowTheHandAlongTheirPrimary) {
  BlendSession s = opened("open-blend", 200);
  const SessionHandle h = test::handle(s, SessionHandle::Kind::trimline, 0, 3);
  const Surface& panel = s.blend(0).trimlines[0]->primary();
  double moved = 0.0;
  std::cout << "reshapes per second of 200 x 200: trimline " << rate([&](int i) {
    const double u = -0.3 - 0.01 * i;
    EXPECT_TRUE(s.drag(h, panel.jet({u, 0.7}).S).done);
    moved = std::max(moved, std::abs(s.job().blends[0].sides[0].trimline->value - u));
  }) << "\n";
  EXPECT_LE(moved, 1e-7);  // a foot is found to the square root of the rounding of its distance
  EXPECT_LE(s.errors(0).gap, 1e-12 * test::size_of(s.grid(0)));
}

}  // namespace
}  // namespace blendwright
