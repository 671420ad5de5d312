#include "parametric/trimline/correspondence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "kernel/base/error.hpp"
#include "parametric/trimline/twist_map.hpp"
#include "tests/parametric/sample_lines.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using namespace test;
using ::testing::HasSubstr;

Trimline circle(double radius, const RigidMotion& placement = {}) {
  return isoline(cylinder(radius, -1.0, 1.0, placement), IsoDirection::constant_u, 0.0);
}
/// A circle about the z axis at height z whose start lies at `angle`; backwards: run through the other way.
Trimline turned_circle(double radius, double z, double angle, bool backwards) {
  const Vec3 axis = backwards ? Vec3(-Vec3::UnitZ()) : Vec3(Vec3::UnitZ());
  return circle(radius, RigidMotion::from_axis({0, 0, z}, axis, {std::cos(angle), std::sin(angle), 0.0}));
}
Trimline ellipse_line(double a, double b, double z = 0.0, double x = 0.0) {
  return Trimline(plane(20.0, RigidMotion::from_axis({0, 0, z}, Vec3::UnitZ(), Vec3::UnitX())),
                  ellipse(a, b, x));
}
Trimline open_line(const Vec3& start, const Vec3& end) {
  const Vec3 d = end - start;
  const Surface s = formula({std::to_string(start[0]) + "+u*" + std::to_string(d[0]),
                             std::to_string(start[1]) + "+u*" + std::to_string(d[1]),
                             std::to_string(start[2]) + "+v+u*" + std::to_string(d[2])},
                            {0.0, 1.0}, {-1.0, 1.0});
  return isoline(s, IsoDirection::constant_v, 0.0);
}

/// J of two lines on [0, 1] by the trapezoid rule on other samples than the library's.
double distance_cost(const Trimline& a, const Trimline& b) {
  constexpr int n = 300;
  double J = 0.0;
  for (int i = 0; i < n; ++i) J += (a.jet((i + 0.5) / n).C() - b.jet((i + 0.5) / n).C()).squaredNorm() / n;
  return J;
}
double speed_spread(const Trimline& line) {
  double least = 1e300, most = 0.0;
  for (int i = 0; i <= 3000; ++i) {
    const double s = line.jet(line.domain().v.at(i / 3000.0)).C1().norm();
    least = std::min(least, s);
    most = std::max(most, s);
  }
  return most / least - 1.0;
}

TEST(Correspondence, JoinsOnlyClosedWithClosed) {
  const Trimline open = open_line({0, 0, 3}, {1, 0, 3});
  EXPECT_THAT(message_of([&] { (void)correspond(circle(1.0), open, {}); }),
              HasSubstr("the trimline of \"from\" is closed and that of \"to\" is open"));
  CorrespondenceSpec offset;
  offset.seam_offset = 0.25;
  EXPECT_THROW((void)correspond(open, open_line({0, 0, 4}, {1, 0, 4}), offset), InputError);
  offset.seam_offset = std::nan("");
  EXPECT_THROW((void)correspond(circle(1.0), circle(2.0), offset), InputError);
}

TEST(Correspondence, SaysWhenAnOpenLineClosesWithACorner) {
  // A drop: at the ends, v = 0 and v = 2 pi, it leaves along (1, 2) and comes back along (-1, 2).
  const auto what = [](double lift) {
    const Curve2 drop = curve<2>(
        [=](const auto& v) {
          return std::array{sin(v), 4.0 * sin(0.5 * v) + lift * v};
        },
        {0.0, 2.0 * pi});
    return message_of([&] { (void)correspond(circle(1.0), Trimline(plane(9.0), drop), {}); });
  };
  // The angle between (1, 2) and (1, -2).
  const std::string corner = "The ends of \"to\" meet at (0, 0, 0), but with a corner of 126.9 deg";
  EXPECT_THAT(what(0.0), HasSubstr(corner));
  EXPECT_THAT(what(0.1), ::testing::Not(HasSubstr("meet at")));
  const Trimline round(plane(9.0), curve<2>(
                                       [](const auto& v) {
                                         return std::array{cos(v), sin(v)};
                                       },
                                       {0.0, 2.0 * pi}));
  EXPECT_THAT(
      message_of([&] { (void)correspond(round, circle(1.0), {}); }),
      HasSubstr("The ends of \"from\" meet at (1, 0, 0) without a corner: it can be given as closed"));
}

TEST(ArcLength, MakesTheSpeedEven) {
  const Curve2 arc = curve<2>([](const auto& v) { return std::array{3.0 * cos(v), sin(v)}; }, {0.3, 2.9});
  const Correspondence open = correspond(Trimline(plane(5.0), arc), open_line({3, 0, 2}, {-3, 0, 2}), {});
  const Correspondence closed = correspond(ellipse_line(3.0, 0.7), ellipse_line(2.0, 1.5, 1.0), {});
  // The library promises an even speed to 1e-6.
  EXPECT_LE(speed_spread(open.line0), 2e-6);
  EXPECT_LE(speed_spread(closed.line0), 2e-6);
  EXPECT_LE(speed_spread(closed.line1), 2e-6);
  EXPECT_GE(speed_spread(ellipse_line(3.0, 0.7)), 1.0) << "the ellipse itself is uneven";
  EXPECT_EQ(open.line0.domain().v, (Interval{0.0, 1.0}));
  EXPECT_TRUE(closed.line0.domain().closed);
  // The ends stay, and the curve is the same one.
  EXPECT_LE((open.line0.jet(1.0).C() - Vec3(3.0 * std::cos(2.9), std::sin(2.9), 0.0)).norm(), 1e-13);
  const Vec3 p = closed.line0.jet(0.37).C();
  EXPECT_NEAR(p[0] * p[0] / 9.0 + p[1] * p[1] / 0.49, 1.0, 1e-13);
}

TEST(ArcLength, IsSmoothAcrossTheSeam) {
  const Trimline line = correspond(ellipse_line(3.0, 0.7), ellipse_line(2.0, 1.5, 1.0), {}).line0;
  const CurveJet<3> start = line.jet(0.0), end = line.jet(1.0);
  // Rounding of the spline's third derivative: control values of size 1 over steps of 1/256 at least: 256^3
  // eps.
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_LE((start.D[k] - end.D[k]).norm(), 1e-13 * std::pow(256.0, static_cast<double>(k)));
}

TEST(ArcLength, LeavesLinesOfConstantSpeedExact) {
  const Correspondence c = correspond(circle(1.0), turned_circle(2.0, 1.0, 0.0, false), {});
  for (int i = 0; i <= 20; ++i) {
    const CurveJet<2> p = c.line1.pcurve().jet(i / 20.0);
    EXPECT_EQ(p.C1()[1], 2.0 * pi);
    EXPECT_EQ(p.C2()[1], 0.0);
  }
  EXPECT_EQ(c.seam_offset, 0.0);
  EXPECT_FALSE(c.reversed);
}

TEST(ArcLength, RefusesALineThatStops) {
  const Curve2 stop = curve<2>([](const auto& v) { return std::array{v * v * v, 0.0 * v}; }, {-1.0, 1.0});
  const Trimline line(plane(5.0), stop), other = open_line({-1, 0, 2}, {1, 0, 2});
  EXPECT_THAT(message_of([&] { (void)correspond(line, other, {}); }), HasSubstr("stops at v = 0 (0, 0, 0)"));
  CorrespondenceSpec given;
  given.rule = CorrespondenceRule::as_given;
  EXPECT_NO_THROW((void)correspond(line, other, given));
}

TEST(Correspondence, MatchesTurnedAndReversedCirclesBack) {
  for_all(
      [](Rng& rng) {
        const double angle = uniform(rng, 0.0, 2.0 * pi);
        const bool backwards = integer(rng, 0, 1) == 1;
        const Correspondence c = correspond(circle(1.0), turned_circle(2.5, 3.0, angle, backwards), {});
        EXPECT_EQ(c.reversed, backwards);
        // Start of line 0 at angle 0: that is the fraction -angle / 2 pi of line 1, or angle / 2 pi
        // backwards.
        const double fraction = (backwards ? angle : -angle) / (2.0 * pi);
        EXPECT_NEAR(std::remainder(c.seam_offset - fraction, 1.0), 0.0, 1e-9);
        const double v = uniform(rng, 0.0, 1.0);
        const Vec3 a = c.line0.jet(v).C(), b = c.line1.jet(v).C();
        EXPECT_LE((2.5 * a + Vec3(0, 0, 3.0) - b).norm(), 2.5 * 2.0 * pi * 1e-9);
        EXPECT_LE(c.twist, 1e-8);
      },
      40);
}

TEST(Correspondence, DoesWhatTheUserSays) {
  CorrespondenceSpec spec;
  spec.reverse = true;
  spec.seam_offset = 0.25;
  for (const CorrespondenceRule rule : {CorrespondenceRule::arc_length, CorrespondenceRule::as_given}) {
    spec.rule = rule;
    const Correspondence c = correspond(circle(1.0), turned_circle(2.0, 3.0, 0.0, false), spec);
    EXPECT_TRUE(c.reversed);
    EXPECT_EQ(c.seam_offset, 0.25);
    const Interval range = c.line1.domain().v;
    EXPECT_LE((c.line1.jet(range.lo).C() - Vec3(0, 2, 3)).norm(), 1e-14)
        << "a quarter along the line as given";
    EXPECT_LE((c.line1.jet(range.at(0.25)).C() - Vec3(2, 0, 3)).norm(), 1e-14) << "then backwards";
    EXPECT_GE(c.twist, 0.5) << "a wrong correspondence is twisted";
  }
}

TEST(Correspondence, AsGivenKeepsTheParameter) {
  CorrespondenceSpec spec;
  spec.rule = CorrespondenceRule::as_given;
  const Correspondence c = correspond(ellipse_line(3.0, 1.0), turned_circle(2.0, 3.0, 1.0, false), spec);
  EXPECT_EQ(c.line0.domain().v, (Interval{0.0, 2.0 * pi}));
  EXPECT_EQ(c.line1.domain().v, (Interval{0.0, 2.0 * pi}));
  for (const double v : {0.0, 1.0, 6.0}) {
    EXPECT_LE((c.line0.jet(v).C() - Vec3(3.0 * std::cos(v), std::sin(v), 0.0)).norm(), 1e-14);
    EXPECT_LE((c.line1.jet(v).C() - Vec3(2.0 * std::cos(v + 1.0), 2.0 * std::sin(v + 1.0), 3.0)).norm(),
              1e-14);
  }
}

TEST(Correspondence, TakesTheCheaperDirectionOfOpenLines) {
  const Trimline line0 = open_line({0, 0, 0}, {4, 1, 0});
  const Correspondence same = correspond(line0, open_line({0, 0, 2}, {4, 0, 2}), {});
  const Correspondence turned = correspond(line0, open_line({4, 0, 2}, {0, 0, 2}), {});
  EXPECT_FALSE(same.reversed);
  EXPECT_TRUE(turned.reversed);
  EXPECT_LE((same.line1.jet(0.3).C() - turned.line1.jet(0.3).C()).norm(), 1e-14);
  EXPECT_EQ(turned.seam_offset, 0.0);
}

TEST(Correspondence, TakesTheCheaperDirectionWhereAreasSayNothing) {
  // Planes at a right angle: N0.N1 = 0.
  const Trimline line0 = circle(1.0);
  const Trimline line1 = Trimline(plane(9.0, RigidMotion::from_axis({3, 0, 0}, Vec3::UnitX(), Vec3::UnitY())),
                                  ellipse(1.0, 2.0, 0.4));
  const Correspondence best = correspond(line0, line1, {});
  for (const bool reverse : {false, true})
    for (int i = 0; i < 16; ++i) {
      CorrespondenceSpec other;
      other.reverse = reverse;
      other.seam_offset = i / 16.0;
      const Correspondence c = correspond(line0, line1, other);
      // Both sums are exact to rounding for these smooth periodic integrands.
      EXPECT_LE(distance_cost(best.line0, best.line1), distance_cost(c.line0, c.line1) + 1e-9);
    }
}

TEST(Correspondence, OfSymmetricLinesStaysInPlace) {
  // Ellipses have two equal optima half a turn apart.
  const Correspondence c = correspond(ellipse_line(3.0, 1.0), ellipse_line(4.0, 2.0, 1.0), {});
  EXPECT_NEAR(std::remainder(c.seam_offset, 1.0), 0.0, 1e-9);
}

TEST(MinimalTwist, LowersTheTwistAndStaysAPeriodicMap) {
  const Trimline line0 = circle(1.0), line1 = ellipse_line(4.0, 1.6, 1.5, 0.8);
  CorrespondenceSpec spec;
  const Correspondence arc = correspond(line0, line1, spec);
  spec.rule = CorrespondenceRule::minimal_twist;
  const Correspondence least = correspond(line0, line1, spec);
  const double before = twist_cost(arc.line0, arc.line1), after = twist_cost(least.line0, least.line1);
  EXPECT_LT(after, 0.99 * before) << before << " -> " << after;
  EXPECT_TRUE(least.line1.domain().closed);
  const CurveJet<3> start = least.line1.jet(0.0), end = least.line1.jet(1.0);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_LE((start.D[k] - end.D[k]).norm(), 1e-12 * std::pow(128.0, static_cast<double>(k)));
  for (int i = 0; i <= 100; ++i)
    EXPECT_GT(least.line1.pcurve().jet(i / 100.0).C1().norm(), 0.1) << "monotone: never stops";
}

TEST(MinimalTwist, IsAMinimumAmongNeighbouringMaps) {
  const Trimline line0 = circle(1.0), line1 = ellipse_line(4.0, 1.6, 1.5, 0.8);
  CorrespondenceSpec spec;
  spec.rule = CorrespondenceRule::minimal_twist;
  const Correspondence least = correspond(line0, line1, spec);
  const double cost = twist_cost(least.line0, least.line1);
  for (int k = 1; k <= 3; ++k)
    for (const double size : {-0.01, 0.01})
      for (const double phase : {0.0, 0.5 * pi}) {
        const Curve<1> wobble =
            curve<1>([=](const auto& x) { return std::array{x + size * sin(2.0 * pi * k * x + phase)}; },
                     {0.0, 1.0}, true);
        // The regularisation 1e-4 int g''^2 moves the optimum a little: allow its own change, below 1e-4
        // times 2 |g''| |dg''| with g'' below 10 and dg'' = size (2 pi k)^2.
        const double allowed = 2e-3 * std::abs(size) * std::pow(2.0 * pi * k, 2);
        EXPECT_GE(twist_cost(least.line0, reparametrised(least.line1, wobble)), cost - allowed);
      }
}

TEST(MinimalTwist, LeavesTheBestMapAlone) {
  CorrespondenceSpec spec;
  spec.rule = CorrespondenceRule::minimal_twist;
  const Correspondence c = correspond(circle(1.0), turned_circle(2.0, 3.0, 0.0, false), spec);
  EXPECT_EQ(c.line1.pcurve().jet(0.3).C2()[1], 0.0) << "coaxial circles: the map stays linear";
  EXPECT_LE((c.line1.jet(0.3).C() - (2.0 * c.line0.jet(0.3).C() + Vec3(0, 0, 3))).norm(), 1e-14);
}

TEST(MinimalTwist, WorksOnOpenLinesAndKeepsTheirEnds) {
  const Curve2 arc = curve<2>(
      [](const auto& v) {
        return std::array{4.0 * cos(v), 1.5 * sin(v)};
      },
      {0.1, 2.0});
  const Trimline line0(plane(5.0), arc), line1 = open_line({3, 1, 2}, {-1, 2, 3});
  CorrespondenceSpec spec;
  const Correspondence before = correspond(line0, line1, spec);
  spec.rule = CorrespondenceRule::minimal_twist;
  const Correspondence after = correspond(line0, line1, spec);
  EXPECT_LT(twist_cost(after.line0, after.line1), twist_cost(before.line0, before.line1));
  for (const double end : {0.0, 1.0})
    EXPECT_LE((after.line1.jet(end).C() - before.line1.jet(end).C()).norm(), 1e-13);
}

}  // namespace
}  // namespace blendwright
