#include "parametric/trimline/crossing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "kernel/base/error.hpp"
#include "parametric/blend.hpp"
#include "tests/parametric/sample_lines.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using namespace test;
using ::testing::HasSubstr;

Trimline flat(const auto& f, Interval range, bool closed) {
  return Trimline(plane(9.0), curve<2>(f, range, closed));
}
Trimline figure_eight(double waist) {  // a waist of 0 crosses itself, otherwise it is a peanut
  return flat(
      [=](const auto& v) {
        return std::array{2.0 * cos(v), waist == 0.0 ? sin(2.0 * v) : (waist + cos(v) * cos(v)) * sin(v)};
      },
      {0.0, 2.0 * pi}, true);
}
/// Petals: a line of radius 1 + b cos(n v) about the origin, or with loops outwards.
Trimline petals(double b, bool closed) {
  return flat(
      [=](const auto& v) {
        return std::array{1.2 * sin(v) + b * sin(-4.0 * v), 1.2 * cos(v) + b * cos(-4.0 * v)};
      },
      {-pi, pi}, closed);
}

/// The promise of the header, seen from the line in space: two parameters, one point.
void expect_crossing(const Trimline& line) {
  const auto found = self_crossing(line);
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(found->v0, found->v1);
  const Vec3 a = line.jet(found->v0).C(), b = line.jet(found->v1).C();
  EXPECT_LE((a - b).norm(), 1e-9 * 30.0);  // no line here is larger than 30
  EXPECT_EQ((a - found->point).norm(), 0.0);
  const double apart = found->v1 - found->v0, length = line.domain().v.length();
  EXPECT_GT(apart, 1e-3 * length);
  EXPECT_LT(apart, line.domain().closed ? (1.0 - 1e-3) * length : 2.0 * length);
}

TEST(SelfCrossing, IsFoundToNewtonAccuracy) {
  const auto found = self_crossing(figure_eight(0.0));
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->v0, 0.5 * pi, 1e-12);
  EXPECT_NEAR(found->v1, 1.5 * pi, 1e-12);
  EXPECT_LE(found->point.norm(), 1e-12);
}

TEST(SelfCrossing, IsNotSeenOnSimpleLines) {
  EXPECT_FALSE(self_crossing(figure_eight(0.01)));  // a waist of 0.02 on a line of size 4
  EXPECT_FALSE(self_crossing(Trimline(plane(9.0), ellipse(3.0, 0.01))));
  EXPECT_FALSE(self_crossing(petals(0.15, true)));
  EXPECT_FALSE(self_crossing(petals(0.15, false)));  // its ends meet
  EXPECT_FALSE(self_crossing(flat(
      [](const auto& v) {
        return std::array{v, sin(40.0 * v)};
      },
      {-3, 3}, false)));
  EXPECT_FALSE(self_crossing(flat(
      [](const auto& v) {
        return std::array{v * v, v * v * v};
      },
      {-1.0, 1.3}, false)));  // a cusp is no crossing
  EXPECT_FALSE(self_crossing(flat(
      [](const auto& v) {
        return std::array{0.1 * v * cos(v), 0.1 * v * sin(v)};
      },
      {1.0, 60.0}, false)));  // a spiral of nine turns
}

TEST(SelfCrossing, IsSeenOfLoopsOverlapsAndTouches) {
  expect_crossing(petals(0.6, true));
  expect_crossing(petals(0.6, false));
  expect_crossing(flat(
      [](const auto& v) {
        return std::array{2.0 * cos(2.0 * v), 2.0 * sin(2.0 * v)};
      },
      {0.0, 2.0 * pi}, true));
  expect_crossing(flat(
      [](const auto& v) {
        return std::array{2.0 * cos(2.0 * v), 1.0 * sin(2.0 * v)};
      },
      {0.0, 2.0 * pi - 1.0}, false));  // 1.7 times round
  expect_crossing(flat([](const auto& v) { return std::array{cos(v), 0.3 * cos(v)}; }, {0.1, 6.0}, false));
  // An end that runs into the line's inside: (v^3 - v, v^2) closes its loop at v = 1 and comes from v = -1.
  expect_crossing(flat([](const auto& v) { return std::array{v * v * v - v, v * v}; }, {-1.5, 1.0}, false));
}

TEST(SelfCrossing, FindsSmallLoopsBetweenTheFirstSamples) {
  // x = v^3 - e v, y = v^2: a loop between v = -sqrt(e) and sqrt(e), at 1/512 of the range -+ 3 it fits
  // between two samples when sqrt(e) < 0.006.
  const auto looped = [](double e) {
    return flat([=](const auto& v) { return std::array{v * v * v - e * v, v * v}; }, {-1.37, 1.5}, false);
  };
  for (const double root : {0.5, 0.05, 0.01}) {
    const auto found = self_crossing(looped(root * root));
    ASSERT_TRUE(found.has_value()) << root;
    // Newton's 1e-9 of the size 4 over the speed 2 root^2 of the crossing branches.
    EXPECT_NEAR(found->v0, -root, 4e-9 / (2.0 * root * root));
    EXPECT_NEAR(found->v1, root, 4e-9 / (2.0 * root * root));
  }
  EXPECT_FALSE(self_crossing(looped(-0.01)));
}

TEST(SelfCrossing, CountsTurnsOfClosedDirections) {
  const Surface s = torus(3.0, 1.0);
  const auto wound = [&](double a, double b, double wave) {
    return Trimline(s, curve<2>(
                           [=](const auto& v) {
                             return std::array{a * v + wave * sin(3.0 * v), b * v};
                           },
                           {0.0, 2.0 * pi}, true));
  };
  EXPECT_FALSE(self_crossing(wound(0.0, 1.0, 0.0)));
  EXPECT_FALSE(self_crossing(wound(1.0, 1.0, 0.4)));
  EXPECT_FALSE(self_crossing(wound(2.0, 3.0, 0.0)));  // a torus knot closes once
  expect_crossing(wound(0.0, 2.0, 0.0));              // twice round the same ring
  expect_crossing(wound(2.0, 2.0, 0.0));
  expect_crossing(wound(1.0, 2.0, 3.0));
  const auto open = [&](double hi) {
    return Trimline(s, curve<2>([](const auto& v) { return std::array{0.5 + 0.0 * v, v}; }, {0.0, hi}));
  };
  EXPECT_FALSE(self_crossing(open(2.0 * pi)));  // its ends meet
  expect_crossing(open(2.0 * pi + 0.01));
}

TEST(SelfCrossing, DoesNotDependOnScaleOrParameter) {
  for_all(
      [](Rng& rng) {
        const double size = std::exp(uniform(rng, -7.0, 1.7)), turn = uniform(rng, 0.0, 2.0 * pi);
        const double b = uniform(rng, 0.0, 1.0) < 0.5 ? 0.15 : 0.6;
        const Trimline line = flat(
            [=](const auto& v) {
              const auto w = v + turn + 0.3 * sin(v);
              return std::array{size * (sin(w) + b * sin(-4.0 * w)),
                                size * (cos(w) + b * cos(-4.0 * w)) * 0.7};
            },
            {0.0, 2.0 * pi}, true);
        EXPECT_EQ(self_crossing(line).has_value(), b == 0.6) << "size " << size << " turn " << turn;
      },
      60);
}

TEST(SelfCrossing, EndsABlend) {
  const Trimline above = isoline(cylinder(1.0, 1.0, 3.0), IsoDirection::constant_u, 2.0);
  const std::string what = message_of([&] { (void)make_blend(above, figure_eight(0.0), BlendSpec{}, 1e-6); });
  EXPECT_THAT(what, HasSubstr("to: the trimline crosses or overlaps itself: v = 1.5708 and v = 4.71239"));
  EXPECT_EQ(message_of([&] { (void)make_blend(above, figure_eight(0.5), BlendSpec{}, 1e-6); }), "no error");
}

TEST(SelfCrossing, CostsLittle) {
  const Trimline ring = isoline(cylinder(2.0, -1.0, 1.0), IsoDirection::constant_u, 0.5);
  const Trimline oval(plane(9.0), ellipse(3.0, 1.0));
  for (const Trimline* line : {&ring, &oval}) {
    double best = 1e9;
    for (int i = 0; i < 20; ++i) {
      const auto start = std::chrono::steady_clock::now();
      EXPECT_FALSE(self_crossing(*line));
      best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    RecordProperty("microseconds", static_cast<int>(1e6 * best));
    EXPECT_LT(best, 3e-3);  // ten times the aim of 0.3 ms, for slow machines and sanitizers
  }
}

TEST(Crossing, OfTwoLinesIsFoundModuloPeriods) {
  const Surface s = torus(3.0, 1.0);
  const auto ring = [&](double u, double start) {
    return Trimline(s, curve<2>(
                           [=](const auto& v) {
                             return std::array{u + 0.0 * v, start + v};
                           },
                           {0.0, 2.0 * pi}, true));
  };
  const auto wave = [&](double u, double a) {
    return Trimline(s, curve<2>(
                           [=](const auto& v) {
                             return std::array{u + a * sin(v), v};
                           },
                           {0.0, 2.0 * pi}, true));
  };
  const auto found = crossing(ring(0.3 + 2.0 * pi, -30.0), wave(0.0, 0.5));
  ASSERT_TRUE(found.has_value());
  EXPECT_LE((ring(0.3 + 2.0 * pi, -30.0).jet(found->v0).C() - wave(0.0, 0.5).jet(found->v1).C()).norm(),
            1e-8);
  EXPECT_NEAR(std::sin(found->v1), 0.6, 1e-9);
  EXPECT_FALSE(crossing(ring(0.51, 4.0), wave(0.0, 0.5)));
  EXPECT_TRUE(crossing(ring(0.5, 4.0), wave(0.0, 0.5)));             // touches
  EXPECT_TRUE(crossing(ring(0.5, 4.0), ring(0.5 - 2.0 * pi, 0.0)));  // the same ring
  EXPECT_FALSE(crossing(ring(0.5, 4.0), ring(0.6, 0.0)));
}

TEST(Crossing, OpenLinesMayShareTheirEnds) {
  const auto line = [](Vec2 a, Vec2 b) {
    return flat(
        [=](const auto& v) {
          return std::array{a[0] + (b[0] - a[0]) * v, a[1] + (b[1] - a[1]) * v};
        },
        {0.0, 1.0}, false);
  };
  EXPECT_FALSE(crossing(line({0, 0}, {1, 1}), line({1, 1}, {2, 0})));
  EXPECT_FALSE(crossing(line({0, 0}, {1, 1}), line({1, 1}, {2, 2})));
  EXPECT_TRUE(crossing(line({0, 0}, {1, 1}), line({0.5, 0.5}, {2, 0})));
  EXPECT_TRUE(crossing(line({0, 0}, {1, 1}), line({0.9, 0.9}, {2, 2})));
  EXPECT_FALSE(crossing(line({0, 0}, {1, 1}), line({0.5, 0.4999}, {2, 0})));
}

}  // namespace
}  // namespace blendwright
