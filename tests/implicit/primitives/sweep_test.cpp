// Sweeps along segments and arcs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/implicit/primitives/sweep_parts.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"
#include "tests/support/golden_folder.hpp"
#include "tests/support/soft_golden.hpp"

namespace blendwright {
namespace {

using namespace test;
constexpr double pi = std::numbers::pi;

Vec3 random_point(Rng& rng, double reach) {
  return {uniform(rng, -reach, reach), uniform(rng, -reach, reach), uniform(rng, -reach, reach)};
}

TEST(SweepArc, OfAWholeTurnWithACircleIsATorus) {
  const auto torus =
      sweep(round_profile(3.0), "sweep_arc", {{"arc_radius", 5.0}, {"angles_deg", Numbers{-30, 330}}});
  ASSERT_TRUE(torus.tape);
  EXPECT_TRUE(torus.warnings.empty());
  for_all([&](Rng& rng) {
    const Vec3 p = random_point(rng, 9.0);
    const double exact = std::hypot(std::hypot(p.x(), p.y()) - 5.0, p.z()) / 3.0;
    // The turn to the arc's middle is off by 2 ulp of 9, over the radius 3.
    EXPECT_NEAR(value_at(*torus.tape, p), exact, 4e-15 * (1.0 + exact));
  });
}

TEST(SweepLine, OfACircleIsACapsuleWhenTheCapIsItsRadius) {
  const auto made =
      sweep(round_profile(2.0), "sweep_line",
            {{"p0", Numbers{-3, 0, 1}}, {"p1", Numbers{4, 0, 1}}, {"u", Numbers{0, 1, 1}}, {"cap", 2.0}});
  ASSERT_TRUE(made.tape);
  for_all([&](Rng& rng) {
    const Vec3 p = random_point(rng, 8.0), foot(std::clamp(p.x(), -3.0, 4.0), 0.0, 1.0);
    EXPECT_NEAR(value_at(*made.tape, p), (p - foot).norm() / 2.0, 1e-14 * (1.0 + p.norm()));
  });
}

// The section is the profile's own, turned by twist k and scaled: (1) of the section, in plain numbers.
TEST(SweepLine, TurnsTheProfileFromUTowardsV) {
  const auto made = sweep(box_profile(3.0, 1.0), "sweep_line",
                          {{"p0", Numbers{0, 0, 0}},
                           {"p1", Numbers{0, 0, 10}},
                           {"u", Numbers{1, 0, 0}},
                           {"scale", Numbers{1, 3}},
                           {"twist_deg", 90.0}});
  ASSERT_TRUE(made.tape);
  for (const double k : {0.0, 0.25, 0.5, 1.0}) {
    const double phi = 0.5 * pi * k, s = 1.0 + 2.0 * k;
    EXPECT_NEAR(value_at(*made.tape, {3.0 * s * std::cos(phi), 3.0 * s * std::sin(phi), 10.0 * k}), 1.0,
                1e-14);
    EXPECT_NEAR(value_at(*made.tape, {-s * std::sin(phi), s * std::cos(phi), 10.0 * k}), 1.0, 1e-14);
  }
}

TEST(SweepLine, EndsAreTheNormOfSectionAndOffset) {
  const auto made = sweep(round_profile(1.0), "sweep_line",
                          {{"p0", Numbers{0, 0, 0}},
                           {"p1", Numbers{0, 0, 10}},
                           {"u", Numbers{1, 0, 0}},
                           {"scale", Numbers{1, 2}},
                           {"cap", 4.0},
                           {"m", 3.0}});
  EXPECT_NEAR(value_at(*made.tape, {1.0, 0.0, 13.0}), std::cbrt(0.125 + 27.0 / 64.0), 1e-15);
  EXPECT_NEAR(value_at(*made.tape, {1.0, 0.0, -3.0}), std::cbrt(1.0 + 27.0 / 64.0), 1e-15);
}

TEST(SweepArc, EndsLieAcrossTheArc) {
  const auto made = sweep(round_profile(1.0), "sweep_arc",
                          {{"arc_radius", 5.0}, {"angles_deg", Numbers{0, 270}}, {"cap", 2.0}});
  // Before the start (5, 0, 0) the tangent is y, beyond the end (0, -5, 0) it is x.
  EXPECT_NEAR(value_at(*made.tape, {5.0, -0.5, 0.0}), 0.25, 1e-15);
  EXPECT_NEAR(value_at(*made.tape, {0.5, -5.0, 0.5}), std::hypot(0.25, 0.5), 1e-15);
  EXPECT_NEAR(value_at(*made.tape, {-5.5, 0.0, 0.0}), 0.5, 1e-15);
}

/// The sweeps that the laws below are tried on, with the box of d = 1 or so.
std::vector<PrimitiveSample> sweeps() {
  const Values line{{"p0", Numbers{-2, 0, 0.5}}, {"p1", Numbers{2, 1, 0}}, {"u", Numbers{0, 0, 1}}};
  const Values quarter{{"arc_radius", 3.0}, {"angles_deg", Numbers{20, 110}}};
  const Values most{{"arc_radius", 3.0}, {"angles_deg", Numbers{-150, 160}}};
  const Values ring{{"arc_radius", 3.0}, {"angles_deg", Numbers{0, 360}}};
  const Values even{}, tapered{{"scale", Numbers{1, 0.5}}}, turned{{"twist_deg", 72.0}};
  const Values both{{"scale", Numbers{0.6, 1}}, {"twist_deg", -200.0}, {"cap", 0.4}, {"m", 4.0}};
  const Box box{Vec3::Constant(-5.0), Vec3::Constant(5.0)};
  std::vector<PrimitiveSample> all;
  const auto add = [&](const char* kind, const Values& a, const Values& b, const NodeSpec& profile) {
    Values values = a;
    values.insert(b.begin(), b.end());
    all.push_back({kind + std::to_string(all.size()), sweep_scene(profile, kind, values), box});
  };
  for (const Values& way : {even, tapered, turned, both}) {
    add("sweep_line", line, way, star_profile(5, 1.0));
    add("sweep_arc", quarter, way, box_profile(1.0, 0.6));
    add("sweep_arc", most, way, star_profile(5, 1.0));
  }
  add("sweep_arc", ring, even, round_profile(1.0));
  add("sweep_arc", ring, turned, star_profile(5, 1.0));
  return all;
}

TEST(Sweeps, HaveGoldenCases) {
  for (const char* kind : {"polar_bar", "sweep_line", "sweep_arc"})
    EXPECT_TRUE(std::ranges::any_of(read_soft_golden(golden_folder()), [&](const SoftCase& c) {
      return c.function == kind && find_node_kind(kind) != nullptr && c.points.size() >= 5;
    })) << kind;
}

TEST(Sweeps, ObeyTheLawsOfEvaluation) {
  for (const PrimitiveSample& s : sweeps()) {
    SCOPED_TRACE(s.id);
    const MadePrimitive made = make_primitive(s.scene);
    ASSERT_TRUE(made.tape) << problem_of(made);
    EXPECT_EQ(evaluator_faults(*made.tape, {.where = s.where, .boxes = 200}), no_faults);
  }
}

TEST(Sweeps, TellWhereTheyAre) {
  for (const PrimitiveSample& s : sweeps()) {
    SCOPED_TRACE(s.id);
    const MadePrimitive made = make_primitive(s.scene);
    ASSERT_TRUE(made.tape);
    EXPECT_TRUE(made.node.distance);
    EXPECT_FALSE(made.node.ray_linear);
    for (const double value : {0.3, 1.0}) {
      const Box box = *made.node.region(value), wide{box.lo - box.size(), box.hi + box.size()};
      int inside = 0;
      Box seen{box.hi, box.lo};
      for_all(
          [&](Rng& rng) {
            const Vec3 p = suite::point_in(rng, integer(rng, 0, 1) == 0 ? wide : box);
            if (value_at(*made.tape, p) > value) return;
            ++inside;
            EXPECT_TRUE(box.contains(p)) << p.transpose();
            seen = hull(seen, {p, p});
          },
          4000);
      EXPECT_GT(inside, 50);
      EXPECT_GT(least_outside(made, value, 60000), value);
      // Not needlessly large: the solid fills at least half of it in every direction.
      EXPECT_TRUE(((seen.size().array()) > 0.5 * box.size().array()).all()) << seen.size().transpose();
    }
  }
}

// Without it, no block of a mesh away from the surface would ever be left out.
TEST(Sweeps, RangesNarrowWithTheBox) {
  for (const PrimitiveSample& s : sweeps()) {
    SCOPED_TRACE(s.id);
    const auto tape = make_primitive(s.scene).tape;
    for_all([&](Rng& rng) {
      const Vec3 p = suite::point_in(rng, s.where);
      if (std::hypot(p.x(), p.y()) < 0.5 || (p.x() < 0.0 && std::abs(p.y()) < 0.5)) return;  // axis and seam
      double widths[2];
      for (int i = 0; i < 2; ++i) {
        const Range r =
            tape->range({p - Vec3::Constant(1e-3 / (1 + 9 * i)), p + Vec3::Constant(1e-3 / (1 + 9 * i))});
        widths[i] = r.hi - r.lo;
      }
      // Linear with a tenfold size, with a margin of 2 for the second order. Slopes are below 20: 1/0.5 of
      // the scale, 1/0.4 of radius or cap, 3 of the star's tips.
      EXPECT_LE(widths[1], 0.2 * widths[0] + 1e-11);
      EXPECT_LE(widths[0], 8.0 * 20.0 * 1e-3 * (1.0 + p.norm()));
    });
  }
}

TEST(Sweeps, WarnWhereAClosedSweepDoesNotMeetItself) {
  const Values ring{{"arc_radius", 3.0}, {"angles_deg", Numbers{0, 360}}};
  const auto warnings = [&](Values more) {
    more.insert(ring.begin(), ring.end());
    return sweep(star_profile(5, 1.0), "sweep_arc", more).warnings;
  };
  EXPECT_TRUE(warnings({}).empty());
  EXPECT_TRUE(warnings({{"twist_deg", 144.0}}).empty());
  ASSERT_EQ(warnings({{"twist_deg", 100.0}}).size(), 1u);
  EXPECT_EQ(warnings({{"twist_deg", 100.0}})[0].where, "twist_deg");
  ASSERT_EQ(warnings({{"scale", Numbers{1, 2}}}).size(), 1u);
  EXPECT_EQ(warnings({{"scale", Numbers{1, 2}}})[0].where, "scale");
}

TEST(Sweeps, RefuseBrokenParameters) {
  const auto line = [](Values values) {
    values.insert({{"p0", Numbers{0, 0, 0}}, {"p1", Numbers{0, 0, 2}}, {"u", Numbers{1, 0, 0}}});
    return problem_of(sweep(round_profile(1.0), "sweep_line", values));
  };
  EXPECT_EQ(line({}), "");
  EXPECT_EQ(line({{"p1", Numbers{0, 0, 0}}}).find("p1: InvalidParameter: is the same point as p0"), 0u);
  EXPECT_EQ(line({{"u", Numbers{0, 0, -3}}}).find("u: InvalidParameter: is parallel to the axis"), 0u);
  EXPECT_EQ(line({{"u", Numbers{0, 0, 0}}}).find("u: InvalidParameter"), 0u);
  EXPECT_EQ(line({{"m", 1.0}}).find("m: InvalidParameter: is 1, must be"), 0u);
  EXPECT_EQ(line({{"cap", 0.0}}).find("cap: InvalidParameter: is 0, must be"), 0u);
  EXPECT_EQ(line({{"scale", Numbers{1, 0}}}).find("scale/1: InvalidParameter: is 0, must be"), 0u);
  const auto arc = [](Values values) {
    values.insert({{"arc_radius", 3.0}, {"angles_deg", Numbers{0, 90}}});
    return problem_of(sweep(round_profile(1.0), "sweep_arc", values));
  };
  EXPECT_EQ(arc({}), "");
  EXPECT_EQ(arc({{"arc_radius", -1.0}}).find("arc_radius: InvalidParameter"), 0u);
  for (const Numbers& angles : {Numbers{90, 0}, Numbers{0, 0}, Numbers{0, 361}})
    EXPECT_EQ(arc({{"angles_deg", angles}}).find("angles_deg: InvalidParameter: goes from"), 0u);
}

}  // namespace
}  // namespace blendwright
