// Sweeps along curves given by formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "implicit/primitives/sweep_curve.hpp"
#include "kernel/base/number_text.hpp"
#include "tests/implicit/primitives/sweep_parts.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"

namespace blendwright {
namespace {

using namespace test;
constexpr double pi = std::numbers::pi;

Values curve(Texts formulas, double t0, double t1, Values more = {}) {
  more.insert({{"curve", std::move(formulas)}, {"t", Numbers{t0, t1}}});
  return more;
}
const Values varied{{"scale", Numbers{1, 0.5}}, {"twist_deg", 70.0}, {"cap", 0.8}, {"m", 3.0}};
Values with(Values a, const Values& b) {
  a.insert(b.begin(), b.end());
  return a;
}

/// The largest difference of two distances over a box, relative to 1 + value.
double difference(const Tape& a, const Tape& b, const Box& where, int points = 3000) {
  Rng rng(5);
  std::vector<Vec3> list;
  for (int i = 0; i < points; ++i) list.push_back(suite::point_in(rng, where));
  const auto x = values_at(a, list), y = values_at(b, list);
  double worst = 0.0;
  for (std::size_t i = 0; i < list.size(); ++i) worst = std::max(worst, std::abs(x[i] - y[i]) / (1.0 + x[i]));
  return worst;
}

// Pieces follow their formulas to 1e-14 of the size 5, slopes of d are below 20: 1e-12.
TEST(SweepCurve, OfAStraightLineIsASweepLine) {
  for (const Values& way : {Values{}, varied}) {
    const auto line =
        sweep(box_profile(1.5, 1.0), "sweep_line",
              with({{"p0", Numbers{1, -2, 0}}, {"p1", Numbers{5, 1, 3}}, {"u", Numbers{0, 1, 2}}}, way));
    const auto made = sweep(box_profile(1.5, 1.0), "sweep_curve",
                            curve({"1+4*t", "-2+3*t", "3*t"}, 0, 1, with({{"u", Numbers{0, 1, 2}}}, way)));
    ASSERT_TRUE(line.tape && made.tape) << problem_of(made);
    const Box where{Vec3(-3, -6, -4), Vec3(9, 5, 7)};
    EXPECT_LE(difference(*line.tape, *made.tape, where), 1e-12);
    const auto moved =
        sweep(box_profile(1.5, 1.0), "sweep_curve",
              curve({"1+4*t", "-2+3*t", "3*t+1e-9"}, 0, 1, with({{"u", Numbers{0, 1, 2}}}, way)));
    EXPECT_GT(difference(*line.tape, *moved.tape, where), 1e-10);
  }
}

// As above; but near the axis, as near as 0.05 among these points, feet move R/r = 80 times as far, and the
// twist and the scale with them, by a slope of about 2: 1e-11. The arc's V is z, that of a curve is W x U =
// -z: profiles are symmetric in v, so the twist changes sign.
TEST(SweepCurve, OfACircleIsASweepArc) {
  for (const Values& way : {Values{}, varied}) {
    Values back = way;
    if (back.contains("twist_deg")) back["twist_deg"] = -std::get<double>(back["twist_deg"]);
    const auto arc = sweep(star_profile(5, 1.2), "sweep_arc",
                           with({{"arc_radius", 4.0}, {"angles_deg", Numbers{0, 200}}}, way));
    const auto made = sweep(
        star_profile(5, 1.2), "sweep_curve",
        curve({"4*cos(t)", "4*sin(t)", "0"}, 0, 200.0 * pi / 180.0, with({{"u", Numbers{1, 0, 0}}}, back)));
    ASSERT_TRUE(arc.tape && made.tape);
    EXPECT_LE(difference(*arc.tape, *made.tape, {Vec3(-7, -5, -3), Vec3(7, 7, 3)}), 1e-11);
  }
  // The parameter's speed does not matter.
  const auto ring =
      sweep(round_profile(1.0), "sweep_arc", {{"arc_radius", 4.0}, {"angles_deg", Numbers{0, 360}}});
  const auto made = sweep(round_profile(1.0), "sweep_curve",
                          curve({"4*cos(t+0.3*sin(t))", "4*sin(t+0.3*sin(t))", "0"}, -pi, pi));
  EXPECT_LE(difference(*ring.tape, *made.tape, {Vec3::Constant(-6), Vec3::Constant(6)}), 1e-12);
}

TEST(SweepCurve, OfACircleAlongAHelixIsTheDistanceToIt) {
  const auto made = sweep(round_profile(0.5), "sweep_curve", curve({"3*cos(t)", "3*sin(t)", "0.8*t"}, 0, 9));
  for_all([&](Rng& rng) {
    const double t = uniform(rng, 0.5, 8.5), r = uniform(rng, 0.01, 2.0), angle = uniform(rng, -pi, pi);
    const double l = std::hypot(3.0, 0.8);
    const Vec3 C(3 * std::cos(t), 3 * std::sin(t), 0.8 * t), N(-std::cos(t), -std::sin(t), 0.0),
        W(-3 * std::sin(t) / l, 3 * std::cos(t) / l, 0.8 / l), B = W.cross(N);
    // Within 2 of the curve (turns are 5 apart, its radius of curvature is 3.2) C(t) is the nearest point.
    EXPECT_NEAR(value_at(*made.tape, C + r * (std::cos(angle) * N + std::sin(angle) * B)), r / 0.5, 1e-12);
  });
}

TEST(SweepCurve, MovesWithItsCurve) {
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized())).toRotationMatrix();
  const Vec3 shift(3, -1, 2), u(1, 0, 0.2);
  const Texts knot{"sin(t)+2*sin(2*t)", "cos(t)-2*cos(2*t)", "-sin(3*t)"};
  Texts moved;
  for (int i = 0; i < 3; ++i) {
    std::string text = number_text(shift[i]);
    for (int j = 0; j < 3; ++j)
      text += "+(" + number_text(R(i, j)) + ")*(" + knot[static_cast<std::size_t>(j)] + ")";
    moved.push_back(text);
  }
  const Vec3 v = R * u;
  const Values way{{"scale", Numbers{0.4, 0.7}}, {"twist_deg", 100.0}};
  const auto here = sweep(star_profile(3, 1.0), "sweep_curve",
                          curve(knot, 0.5, 4.0, with(way, {{"u", Numbers{u.x(), u.y(), u.z()}}})));
  const auto there = sweep(star_profile(3, 1.0), "sweep_curve",
                           curve(moved, 0.5, 4.0, with(way, {{"u", Numbers{v.x(), v.y(), v.z()}}})));
  ASSERT_TRUE(here.tape && there.tape) << problem_of(there);
  for_all([&](Rng& rng) {
    const Vec3 p(uniform(rng, -4, 4), uniform(rng, -4, 4), uniform(rng, -2, 2));
    const double d = value_at(*here.tape, p);
    // Slopes 1/(0.4 of the scale) times 3 at the tips' flanks; coordinates of 10 are rounded to 2e-15, feet
    // near the medial axis to 100 times as much.
    EXPECT_NEAR(value_at(*there.tape, R * p + shift), d, 1e-11 * (1.0 + d));
  });
}

/// A closed curve whose frame does not come back to itself.
const Texts loop{"3*cos(t)", "2*sin(t)", "0.9*sin(2*t+0.4)"};

/// The largest jump of d across the plane through C(0) with normal C'(0), near the curve.
double seam_jump(const Tape& tape) {
  const Vec3 C(3.0, 0.0, 0.9 * std::sin(0.4)), W = Vec3(0.0, 2.0, 1.8 * std::cos(0.4)).normalized();
  double worst = 0.0;
  Rng rng(2);
  for (int i = 0; i < 200; ++i) {
    Vec3 p(uniform(rng, -0.6, 0.6), uniform(rng, -0.6, 0.6), uniform(rng, -0.6, 0.6));
    p -= p.dot(W) * W;
    worst = std::max(worst, std::abs(value_at(tape, C + p + 1e-7 * W) - value_at(tape, C + p - 1e-7 * W)));
  }
  return worst;
}

TEST(SweepCurve, ClosedCurvesCloseTheirField) {
  const auto made = sweep(star_profile(4, 0.6), "sweep_curve", curve(loop, 0, 2.0 * pi));
  ASSERT_TRUE(made.tape) << problem_of(made);
  EXPECT_TRUE(made.warnings.empty());
  EXPECT_LE(seam_jump(*made.tape), 1e-5);  // slopes below 20 over 2e-7
  // A twist of one period of the profile closes too, any other does not and is warned of.
  const auto turned =
      sweep(star_profile(4, 0.6), "sweep_curve", curve(loop, 0, 2.0 * pi, {{"twist_deg", 90.0}}));
  EXPECT_TRUE(turned.warnings.empty());
  EXPECT_LE(seam_jump(*turned.tape), 1e-5);
  EXPECT_GT(difference(*made.tape, *turned.tape, {Vec3(-4, -3, -2), Vec3(4, 3, 2)}), 1e-2);
  const auto torn =
      sweep(star_profile(4, 0.6), "sweep_curve", curve(loop, 0, 2.0 * pi, {{"twist_deg", 30.0}}));
  EXPECT_EQ(torn.warnings.size(), 1u);
  EXPECT_GT(seam_jump(*torn.tape), 1e-2);
  const auto stepped =
      sweep(star_profile(4, 0.6), "sweep_curve", curve(loop, 0, 2.0 * pi, {{"scale", Numbers{1, 0.5}}}));
  EXPECT_EQ(stepped.warnings.size(), 1u);
  EXPECT_GT(seam_jump(*stepped.tape), 1e-2);
}

std::vector<PrimitiveSample> samples() {
  const Texts wave{"t", "sin(t)", "0.3*t^2"};
  const Box flat{Vec3(-5, -4, -3), Vec3(5, 4, 3)}, tall{Vec3(-4, -3, -2), Vec3(4, 3, 5)};
  return {{"open", sweep_scene(round_profile(0.8), "sweep_curve", curve(wave, -2.5, 2.5)), tall},
          {"open, varied", sweep_scene(star_profile(5, 1.0), "sweep_curve", curve(wave, -2.5, 2.5, varied)),
           tall},
          {"steep",
           sweep_scene(round_profile(0.8), "sweep_curve",
                       curve({"t", "0.1*t^2", "0"}, -0.5, 0.5, {{"scale", Numbers{4, 0.3}}})),
           {Vec3(-1, -4, -4), Vec3(1, 4, 4)}},
          {"closed, round", sweep_scene(round_profile(0.5), "sweep_curve", curve(loop, 0, 2.0 * pi)), flat},
          {"closed, star", sweep_scene(star_profile(4, 0.6), "sweep_curve", curve(loop, 0, 2.0 * pi)), flat},
          {"closed, torn",
           sweep_scene(box_profile(0.6, 0.3), "sweep_curve",
                       curve(loop, 0, 2.0 * pi, {{"scale", Numbers{1, 0.5}}})),
           flat}};
}

TEST(SweepCurve, ObeysTheLawsOfEvaluation) {
  for (const PrimitiveSample& s : samples()) {
    SCOPED_TRACE(s.id);
    const auto tape = make_primitive(s.scene).tape;
    ASSERT_TRUE(tape);
    EXPECT_EQ(evaluator_faults(*tape, {.where = s.where, .boxes = 200}), no_faults);
  }
}

// Ranges of small boxes, most of which decide what a mesh costs: every one of circular profiles without taper
// has at most the Lipschitz width; of others all but those that touch the medial axis.
TEST(SweepCurve, RangesNarrowWithTheBox) {
  for (const PrimitiveSample& s : samples()) {
    SCOPED_TRACE(s.id);
    const auto tape = make_primitive(s.scene).tape;
    const bool round = s.id == "open" || s.id == "closed, round";
    constexpr double h = 1e-3;
    int wide = 0, all = 0;
    for_all(
        [&](Rng& rng) {
          const Vec3 p = suite::point_in(rng, s.where);
          const Range r = tape->range({p - Vec3::Constant(h), p + Vec3::Constant(h)});
          const double width = (r.hi - r.lo) / (2.0 * std::sqrt(3.0) * h);
          ++all;
          // Round: 1/radius = 2, and sqrt(2) 2 beyond an end with cap 1. Others: 20 as for segments and arcs.
          if (width > (round ? 3.0 : 4.0 * 20.0 * (1.0 + p.norm()))) ++wide;
        },
        1000);
    EXPECT_LE(wide, all / 25);
  }
}

TEST(SweepCurve, TellsWhereItIs) {
  for (const PrimitiveSample& s : samples()) {
    SCOPED_TRACE(s.id);
    const MadePrimitive made = make_primitive(s.scene);
    for (const double value : {0.3, 1.0}) {
      const Box box = *made.node.region(value), wide{box.lo - 0.3 * box.size(), box.hi + 0.3 * box.size()};
      Box seen{box.hi, box.lo};
      for_all(
          [&](Rng& rng) {
            const Vec3 p = suite::point_in(rng, wide);
            if (value_at(*made.tape, p) > value) return;
            EXPECT_TRUE(box.contains(p)) << p.transpose();
            seen = hull(seen, {p, p});
          },
          5000);
      EXPECT_GT(least_outside(made, value, 20000), value);
      EXPECT_TRUE((seen.size().array() > 0.5 * box.size().array()).all()) << seen.size().transpose();
    }
  }
}

TEST(SweepCurve, RefusesBrokenParametersByTheirKey) {
  const auto problem = [](Texts formulas, double t0, double t1, Values more = {}) {
    return problem_of(
        sweep(round_profile(1.0), "sweep_curve", curve(std::move(formulas), t0, t1, std::move(more))));
  };
  EXPECT_EQ(problem({"t", "t^2", "0"}, 0, 1), "");
  EXPECT_EQ(problem({"t^2", "t^3", "0"}, -1, 1).find("curve: InvalidParameter: has C' = 0"), 0u);
  EXPECT_EQ(problem({"t", "t^^2", "0"}, 0, 1).find("curve/1: InvalidParameter: "), 0u);
  EXPECT_EQ(problem({"t", "t^2", "0"}, 1, 1).find("t: InvalidParameter: goes from 1 to 1, must go up"), 0u);
  EXPECT_EQ(
      problem({"t", "0", "0"}, 0, 1, {{"u", Numbers{1, 0, 0}}}).find("u: InvalidParameter: is parallel"), 0u);
  EXPECT_EQ(problem({"t", "0", "0"}, 0, 1, {{"m", 0.5}}).find("m: InvalidParameter"), 0u);
}

}  // namespace
}  // namespace blendwright
