#include "parametric/trimline/trimline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kernel/base/error.hpp"
#include "tests/parametric/sample_lines.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using namespace test;
using ::testing::HasSubstr;

/// Winds once round the torus and wobbles in the tube angle.
Curve2 wavy(double a, double b, double phase) {
  return curve<2>(
      [=](const auto& v) {
        return std::array{a + b * sin(2.0 * v + phase), v + 0.2 * cos(v)};
      },
      {0.0, 2.0 * pi}, true);
}

TEST(Trimline, LiesOnItsPrimaryToRounding) {
  for_all([](Rng& rng) {
    const double R = 3.0, r = 1.25;
    const Trimline line(torus(R, r), wavy(uniform(rng, -3, 3), uniform(rng, 0.1, 0.6), uniform(rng, 0, 6)));
    const Vec3 p = line.jet(uniform(rng, 0.0, 2.0 * pi)).C();
    // Rounding of a few operations on coordinates up to 4.25: 4.25 * 2.2e-16 * a few.
    EXPECT_NEAR(std::hypot(std::hypot(p[0], p[1]) - R, p[2]), r, 1e-14);
  });
}

TEST(Trimline, JetAgreesWithCentralDifferences) {
  for_all(
      [](Rng& rng) {
        const Trimline line(torus(3.0, 1.25), wavy(uniform(rng, -3, 3), 0.4, uniform(rng, 0, 6)));
        const double v = uniform(rng, 0.1, 6.1), h = 2e-3;
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3 expected = difference([&](double x) { return line.jet(x).D[k]; }, v, h);
          // The line's eighth derivative stays below 4.25 * 4^8 (two frequencies of at most 2 in each
          // factor): h^4 / 30 * 2.8e5 = 1.5e-7.
          EXPECT_LE((line.jet(v).D[k + 1] - expected).norm(), 1.5e-7) << "order " << k + 1;
        }
      },
      50);
}

TEST(Trimline, OfAClosedDirectionAcceptsAnyV) {
  const Trimline line = isoline(cylinder(2.0, -1.0, 1.0), IsoDirection::constant_u, 0.5);
  ASSERT_TRUE(line.domain().closed);
  for (const double v : {-7.0, 1.0, 9.0, 100.0})
    // Wrapping rounds v by at most 100 * 2.2e-16.
    EXPECT_LE((line.jet(v).C() - Vec3(2.0 * std::cos(v), 2.0 * std::sin(v), 0.5)).norm(), 1e-13);
}

TEST(Trimline, LeavingAnOpenDomainIsAnErrorThatSaysWhereAndHowFar) {
  const Surface s = cylinder(2.0, -1.0, 1.0);
  const std::string what = message_of([&] { (void)isoline(s, IsoDirection::constant_u, 1.5); });
  EXPECT_THAT(what, HasSubstr("at v = 0 (2, 0, 1.5)"));
  EXPECT_THAT(what, HasSubstr("u = 1.5 is 5.0e-01 beyond [-1, 1]"));
  EXPECT_NO_THROW(
      (void)isoline(s, IsoDirection::constant_u, 1.0 + 1e-9));  // the slack is 1e-9 of the length 2
  EXPECT_THROW((void)isoline(s, IsoDirection::constant_u, 1.0 + 3e-9), GeometryError);
  EXPECT_THROW((void)isoline(s, IsoDirection::constant_u, std::nan("")), GeometryError);
  // A closed direction has no border: the pcurve may run unrolled.
  EXPECT_NO_THROW((void)isoline(s, IsoDirection::constant_u, 0.0, Interval{5.0, 8.0}));
  EXPECT_THROW((void)isoline(s, IsoDirection::constant_u, 0.0, Interval{0.0, 7.0}), GeometryError);
  EXPECT_THROW((void)isoline(s, IsoDirection::constant_u, 0.0, Interval{1.0, 1.0}), GeometryError);
}

TEST(Trimline, MayLeaveAnOpenDomainByTheSlackOfItsPart) {
  const Surface s = formula({"100*u", "v", "0.1*v^2"}, {0.0, 1.74}, {-1.0, 1.0});
  const auto beyond = [&](double over, double slack) {  // in space: the domain ends at x = 174
    const Curve2 pcurve = curve<2>(
        [=](const auto& v) {
          return std::array{1.74 + over / 100.0 + 0.0 * v, v};
        },
        {-1.0, 1.0});
    return message_of([&] { Trimline(s, pcurve, slack); });
  };
  EXPECT_EQ(beyond(1.2e-5, 1.3e-5), "no error");
  EXPECT_THAT(beyond(1.2e-5, 1.1e-5), HasSubstr("the trimline leaves its primary"));
  EXPECT_THAT(beyond(1.2e-5, 0.0), HasSubstr("the trimline leaves its primary"));
  EXPECT_THAT(beyond(std::nan(""), 1.0), HasSubstr("the trimline leaves its primary"));
}

TEST(Trimline, CalledClosedMustClose) {
  const auto spiral = [](double rise) {
    return curve<2>([rise](const auto& v) { return std::array{rise * v, v}; }, {0.0, 2.0 * pi}, true);
  };
  const Surface s = cylinder(1.0, -1.0, 1.0);
  EXPECT_THAT(message_of([&] { Trimline(s, spiral(0.1)); }), HasSubstr("6.3e-01 apart"));
  EXPECT_NO_THROW(Trimline(s, spiral(1e-8)));  // 6e-8 of a line of size 2
}

TEST(Trimline, KnowsItsLength) {
  EXPECT_NEAR(isoline(cylinder(2.0, -1, 1), IsoDirection::constant_u, 0.0).length(), 4.0 * pi, 1e-13);
  // Perimeter of an ellipse: 4 a E(e).
  const double a = 3.0, b = 1.0, e = std::sqrt(1.0 - b * b / (a * a));
  EXPECT_NEAR(Trimline(plane(5.0), ellipse(a, b)).length(), 4.0 * a * std::comp_ellint_2(e), 1e-11);
}

TEST(Isoline, IsClosedOnlyOverAWholeTurn) {
  const Surface s = cylinder(2.0, -1.0, 1.0);
  EXPECT_TRUE(isoline(s, IsoDirection::constant_u, 0.0, Interval{1.0, 1.0 + 2.0 * pi}).domain().closed);
  EXPECT_FALSE(isoline(s, IsoDirection::constant_u, 0.0, Interval{0.0, 6.0}).domain().closed);
  EXPECT_FALSE(isoline(s, IsoDirection::constant_v, 0.0).domain().closed);
  EXPECT_EQ(isoline(s, IsoDirection::constant_v, 0.5).domain().v, (Interval{-1.0, 1.0}));
}

TEST(Reparametrised, RunsThroughTheSamePointsWithTheChainRule) {
  const Trimline line(torus(3.0, 1.25), wavy(1.0, 0.4, 0.5));
  const Curve<1> map =
      curve<1>([](const auto& x) { return std::array{1.0 - 2.0 * pi * x + 0.3 * sin(2.0 * pi * x)}; },
               {0.0, 1.0}, true);
  const Trimline fresh = reparametrised(line, map);
  EXPECT_TRUE(fresh.domain().closed);
  for (int i = 0; i <= 40; ++i) {
    const double x = i / 40.0;
    // Both evaluate the same formula at parameters that differ by rounding of size 2 pi.
    EXPECT_LE((fresh.jet(x).C() - line.jet(map.point(x)[0]).C()).norm(), 1e-13);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 expected = difference([&](double t) { return fresh.jet(t).D[k]; }, x, 4e-4);
      // As above with frequencies 2 pi times higher: h^4/30 * 4.25 (4 * 2 pi)^(k+5) stays below 1e-6 of
      // |D^(k+1)|'s scale 4.25 (8 pi)^(k+1) because (8 pi h)^4 / 30 = 3.4e-10.
      EXPECT_LE((fresh.jet(x).D[k + 1] - expected).norm(),
                1e-9 * 4.25 * std::pow(8.0 * pi, static_cast<double>(k + 1)));
    }
  }
}

TEST(Reparametrised, GoesOnUnrolledBeyondTheSeam) {
  const Trimline line = isoline(cylinder(2.0, -1.0, 1.0), IsoDirection::constant_u, 0.0);
  const Curve<1> map =
      curve<1>([](const auto& x) { return std::array{4.0 + 2.0 * pi * x}; }, {0.0, 1.0}, true);
  const Trimline fresh = reparametrised(line, map);
  for (int i = 0; i <= 50; ++i)
    EXPECT_NEAR(fresh.pcurve().point(i / 50.0)[1], 4.0 + 2.0 * pi * i / 50.0, 1e-14)
        << "the pcurve must not jump";
}

TEST(Reparametrised, RejectsMapsThatTurnBackOrLeaveTheLine) {
  const Trimline open = isoline(cylinder(2.0, -1.0, 1.0), IsoDirection::constant_v, 0.0);
  const auto map = [](double a, double b) {
    return curve<1>([=](const auto& x) { return std::array{a * x + b * x * x}; }, {-1.0, 1.0});
  };
  EXPECT_NO_THROW((void)reparametrised(open, map(0.9, 0.1)));
  EXPECT_THROW((void)reparametrised(open, map(0.1, 0.4)), GeometryError);
  EXPECT_THROW((void)reparametrised(open, map(1.1, 0.0)), GeometryError);
}

/// A wavy ring of radius 5 about the z axis.
Curve3 ring() {
  return curve<3>(
      [](const auto& v) {
        return std::array{5.0 * cos(v), 5.0 * sin(v), 0.3 * sin(2.0 * v)};
      },
      {0.0, 2.0 * pi}, true);
}

TEST(Projected, ToTheClosestPointOfACylinderIsRadial) {
  const Trimline line = projected(cylinder(3.0, -1.0, 1.0), ring());
  EXPECT_TRUE(line.domain().closed);
  const Curve3 exact = curve<3>(
      [](const auto& v) {
        return std::array{3.0 * cos(v), 3.0 * sin(v), 0.3 * sin(2.0 * v)};
      },
      {0.0, 2.0 * pi}, true);
  for (int i = 0; i <= 300; ++i) {
    const double v = 2.0 * pi * i / 300;
    for (std::size_t k = 0; k < 4; ++k)
      // Newton ends at rounding of parameters of size 2 pi; derivatives up to 3 * 2^3 amplify it.
      EXPECT_LE((line.jet(v).D[k] - exact.jet(v).D[k]).norm(), 1e-13) << "order " << k << " at " << v;
  }
  // Once round: the parameter angle advances by a whole turn.
  EXPECT_NEAR(line.pcurve().point(2.0 * pi)[1] - line.pcurve().point(0.0)[1], 2.0 * pi, 1e-13);
}

TEST(Projected, AlongADirectionIsTheExactIntersection) {
  const Curve3 circle = curve<3>(
      [](const auto& v) {
        return std::array{0.0 * v + 5.0, 1.6 * cos(v), 1.6 * sin(v)};
      },
      {0.0, 2.0 * pi}, true);
  const Trimline line = projected(cylinder(3.0, -2.0, 2.0), circle, Vec3(-2.0, 0.0, 0.0));
  const Curve3 exact = curve<3>(
      [](const auto& v) {
        const auto y = 1.6 * cos(v);
        return std::array{sqrt(9.0 - y * y), y, 1.6 * sin(v)};
      },
      {0.0, 2.0 * pi}, true);
  for (int i = 0; i <= 300; ++i) {
    const double v = 2.0 * pi * i / 300;
    for (std::size_t k = 0; k < 4; ++k) EXPECT_LE((line.jet(v).D[k] - exact.jet(v).D[k]).norm(), 1e-13);
  }
}

TEST(Projected, FeetOnAFreeSurfaceAreOrthogonalWithExactDerivatives) {
  const Surface hill = formula({"u", "v", "0.4*cos(u)*cos(1.3*v)"}, {-3.0, 3.0}, {-3.0, 3.0});
  const Curve3 loop = curve<3>(
      [](const auto& v) {
        return std::array{1.5 * cos(v), 1.2 * sin(v), 0.7 + 0.1 * sin(v)};
      },
      {0.0, 2.0 * pi}, true);
  const Trimline line = projected(hill, loop);
  for (int i = 0; i < 60; ++i) {
    const double v = 2.0 * pi * (i + 0.3) / 60;
    const Vec2 at = line.pcurve().point(v);
    const SurfaceJet s = hill.jet({at[0], at[1]});
    EXPECT_LE(std::abs((s.S - loop.point(v)).dot(s.Su)), 1e-14);
    EXPECT_LE(std::abs((s.S - loop.point(v)).dot(s.Sv)), 1e-14);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 expected = difference([&](double x) { return line.pcurve().jet(x).D[k]; }, v, 2e-3);
      // h^4/30 = 5e-13 times an eighth derivative that the hill's bends keep below 1e5.
      EXPECT_LE((line.pcurve().jet(v).D[k + 1] - expected).norm(), 5e-8);
    }
  }
}

TEST(Projected, EvaluationDoesNotDependOnWhatWasAskedBefore) {
  const Trimline line = projected(torus(3.0, 1.0), ring());
  const CurveJet<3> fresh = line.jet(2.7);
  (void)line.jet(6.1);
  (void)line.jet(0.1);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(line.jet(2.7).D[k], fresh.D[k]);
}

TEST(Projected, WithoutAFootInTheDomainIsAnErrorThatSaysWhere) {
  const std::string low = message_of([] { (void)projected(cylinder(3.0, 0.0, 1.0), ring()); });
  EXPECT_THAT(low, HasSubstr("no projection on the primary's domain at v = "));
  EXPECT_THAT(low, HasSubstr("away"));
  const Curve3 wide = curve<3>(
      [](const auto& v) {
        return std::array{0.0 * v + 5.0, 4.0 * cos(v), 0.5 * sin(v)};
      },
      {0.0, 2.0 * pi}, true);
  EXPECT_THROW((void)projected(cylinder(3.0, -2.0, 2.0), wide, Vec3::UnitX()), GeometryError);
  EXPECT_THROW((void)projected(cylinder(3.0, -2.0, 2.0), wide, Vec3::Zero()), InputError);
  // Through the axis: the closest point jumps to the other side.
  const Curve3 through = curve<3>(
      [](const auto& v) {
        return std::array{1.0 + cos(v), 0.5 * sin(v), 0.0 * v};
      },
      {0.0, 2.0 * pi}, true);
  EXPECT_THROW((void)projected(cylinder(3.0, -2.0, 2.0), through), GeometryError);
}

std::vector<DegeneratePoint> degenerate_on_plane(const auto& f, Interval range) {
  return degenerate_points(Trimline(plane(5.0), curve<2>(f, range)));
}

TEST(DegeneratePoints, AreNoneOnRegularLines) {
  EXPECT_TRUE(degenerate_points(isoline(cylinder(2, -1, 1), IsoDirection::constant_u, 0.0)).empty());
  EXPECT_TRUE(degenerate_points(Trimline(plane(5.0), ellipse(4.0, 0.05))).empty());
}

TEST(DegeneratePoints, TellAStopFromACusp) {
  const auto stop = degenerate_on_plane(
      [](const auto& v) {
        return std::array{v * v * v, 0.0 * v};
      },
      {-1.0, 1.3});
  ASSERT_EQ(stop.size(), 1u);
  EXPECT_EQ(stop[0].kind, DegeneratePoint::Kind::cusp);
  EXPECT_NEAR(stop[0].v, 0.0, 1e-8);
  EXPECT_TRUE(stop[0].harmless());
  const auto cusp = degenerate_on_plane(
      [](const auto& v) {
        return std::array{v * v, v * v * v};
      },
      {-1.0, 1.3});
  ASSERT_EQ(cusp.size(), 1u);
  EXPECT_NEAR(cusp[0].v, 0.0, 1e-8);
  EXPECT_FALSE(cusp[0].harmless());
  EXPECT_NEAR(cusp[0].tangent_turn, pi,
              1e-6);  // the tangent turns back; its limits bend by O(step) = 2e-5 squared
  EXPECT_LE(cusp[0].normal_turn, 1e-12);
}

TEST(DegeneratePoints, FindPolesOnTheLine) {
  const Surface folded = formula({"u", "v^3", "0.1*u^2"}, {-1.0, 1.0}, {-1.0, 1.0});
  const Curve2 diagonal = curve<2>([](const auto& v) { return std::array{v, 1.0 * v}; }, {-1.0, 0.8});
  const auto found = degenerate_points(Trimline(folded, diagonal));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, DegeneratePoint::Kind::pole);
  EXPECT_NEAR(found[0].v, 0.0, 1e-8);
  EXPECT_TRUE(found[0].harmless());
}

TEST(DegeneratePoints, SeeTheCornerAtTheSeamOfTheIrregularCone) {
  // (cos v, v sin v) starts with C' = 0 in the direction (-1, 2) and ends along (0, 1).
  const Surface cone = formula({"1.2*u*cos(v)", "1.2*u*v*sin(v)", "2*u"}, {0.1, 1.0}, {0.0, 2.0 * pi});
  const Curve2 around = curve<2>(
      [](const auto& v) {
        return std::array{0.0 * v + 0.3, v};
      },
      {0.0, 2.0 * pi}, true);
  const auto found = degenerate_points(Trimline(cone, around));
  ASSERT_FALSE(found.empty());
  for (const DegeneratePoint& p : found) {
    EXPECT_NEAR(p.v, 0.0, 1e-8);
    EXPECT_FALSE(p.harmless());
    EXPECT_NEAR(p.tangent_turn, std::atan2(1.0, 2.0), 1e-6);
  }
}

TEST(DegeneratePoints, SayWhenAWholeStretchDegenerates) {
  const auto found = degenerate_points(isoline(sphere(2.0), IsoDirection::constant_u, pi / 2.0));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].normal_turn, pi);
  EXPECT_FALSE(found[0].harmless());
}

}  // namespace
}  // namespace blendwright
