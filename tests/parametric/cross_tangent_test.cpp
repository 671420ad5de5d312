#include "parametric/cross_tangent/cross_tangent.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/geometry/curvature.hpp"
#include "tests/parametric/sample_lines.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using namespace test;
using ::testing::HasSubstr;

constexpr double tolerance = 1e-6;

std::array<SideSpec, 2> both(const SideSpec& side) { return {side, side}; }
SideSpec side_of(MagnitudeRule rule, double factor = 1.0, Continuity continuity = Continuity::G1) {
  SideSpec s;
  s.rule = rule;
  s.continuity = continuity;
  s.factor = {{0.0, factor}};
  return s;
}
CrossTangents tangents(const Correspondence& lines, const std::array<SideSpec, 2>& sides) {
  return cross_tangents(lines, sides, tolerance);
}
Vec3 value(const Series3& s) { return derivative(s, 0); }

/// A cylinder of radius 1 above a plane: the trimlines are circles of radius 1 at height 2 and of radius 3 at
/// 0.
Correspondence fillet() {
  return correspond(isoline(cylinder(1.0, 1.0, 5.0), IsoDirection::constant_u, 2.0),
                    Trimline(plane(9.0), ellipse(3, 3)), {});
}
/// Two coaxial cylinders of radius 1 (above) and 2 (below).
Correspondence coaxial() {
  return correspond(isoline(cylinder(1.0, 1.0, 5.0), IsoDirection::constant_u, 2.0),
                    isoline(cylinder(2.0, -5.0, 1.0), IsoDirection::constant_u, 0.0), {});
}
/// Wavy lines on a torus and on a free surface: nothing is constant.
Correspondence wild(CorrespondenceRule rule = CorrespondenceRule::arc_length) {
  const Trimline line0(torus(3.0, 1.0), curve<2>(
                                            [](const auto& v) {
                                              return std::array{1.4 + 0.2 * sin(2.0 * v), v + 0.1 * cos(v)};
                                            },
                                            {0.0, 2.0 * pi}, true));
  const Surface roof = formula({"u", "v", "3 + 0.1*u^2 - 0.05*u*v + 0.2*sin(v)"}, {-3.0, 3.0}, {-3.0, 3.0});
  CorrespondenceSpec spec;
  spec.rule = rule;
  return correspond(line0, Trimline(roof, ellipse(1.5, 1.2, 0.1, 0.2)), spec);
}

SurfaceJet primary_jet(const Trimline& line, double v) {
  const Vec2 p = line.pcurve().point(v);
  return line.primary().jet({p[0], p[1]});
}

TEST(CrossTangent, LiesInTheTangentPlaneWithTheMagnitudeAsked) {
  const Correspondence lines = wild();
  const CrossTangents t = tangents(lines, both(side_of(MagnitudeRule::constant, 1.7)));
  for_all([&](Rng& rng) {
    const double v = uniform(rng, 0.0, 1.0);
    for (std::size_t i = 0; i < 2; ++i) {
      const Trimline& line = i == 0 ? lines.line0 : lines.line1;
      const Vec3 T = value(t.ends[i].series(v).T), n = unit_normal(primary_jet(line, v));
      EXPECT_NEAR(T.dot(n), 0.0, 1e-14);  // a few roundings of unit vectors, times 1.7
      EXPECT_NEAR(T.norm(), 1.7, 1e-14);
      EXPECT_NEAR(T.dot(line.jet(v).C1().normalized()), 0.0, 1e-14)
          << "the conormal is perpendicular to the line";
      EXPECT_LE((value(t.ends[i].series(v).C) - line.jet(v).C()).norm(), 1e-15);
    }
  });
}

TEST(CrossTangent, SecondDerivativeHasThePrimarysNormalCurvature) {
  const Correspondence lines = wild();
  std::array<SideSpec, 2> sides = both(side_of(MagnitudeRule::circle_like, 1.2, Continuity::G2));
  sides[0].tangent_angle = degrees(20.0);
  const CrossTangents t = tangents(lines, sides);
  for_all([&](Rng& rng) {
    const double v = uniform(rng, 0.0, 1.0);
    for (std::size_t i = 0; i < 2; ++i) {
      const SurfaceJet s = primary_jet(i == 0 ? lines.line0 : lines.line1, v);
      const EndSeries end = t.ends[i].series(v);
      const Vec3 T = value(end.T), D = value(end.D), n = unit_normal(s);
      // II(T, T) = m^2 times the normal curvature in the direction of T.
      EXPECT_NEAR(D.dot(n), T.squaredNorm() * normal_curvature(s, T, n), 1e-12);
      EXPECT_LE(D.cross(n).norm(), 1e-13) << "D is normal";
      EXPECT_GE(D.norm(), 1e-4) << "and not zero here";
    }
  });
}

TEST(CrossTangent, SecondDerivativeIsKnownOnASphereAndZeroAlongACylinder) {
  const Correspondence lines =
      correspond(isoline(sphere(2.0), IsoDirection::constant_u, 0.3),
                 isoline(cylinder(1.0, 3.0, 5.0), IsoDirection::constant_u, 4.0), {});
  const CrossTangents t = tangents(lines, both(side_of(MagnitudeRule::constant, 1.5, Continuity::G2)));
  const EndSeries a = t.ends[0].series(0.2);
  EXPECT_LE((value(a.D) + 1.5 * 1.5 / 4.0 * value(a.C)).norm(), 1e-13) << "towards the centre, m^2 / r";
  EXPECT_LE(value(t.ends[1].series(0.2).D).norm(), 1e-14);
}

TEST(CrossTangent, DerivativesAlongVAgreeWithCentralDifferences) {
  std::array<SideSpec, 2> sides{side_of(MagnitudeRule::circle_like, 1.0, Continuity::G2),
                                side_of(MagnitudeRule::chord, 0.8, Continuity::G2)};
  sides[1].tangent_angle = degrees(-15.0);
  sides[0].factor = {{0.0, 1.0}, {0.3, 1.3}, {0.6, 0.9}};
  const CrossTangents t = tangents(wild(CorrespondenceRule::as_given), sides);
  const double period = 2.0 * pi, h = 2e-3;
  for_all(
      [&](Rng& rng) {
        const double v = uniform(rng, 0.0, period);
        for (std::size_t i = 0; i < 2; ++i)
          for (int k = 0; k < 3; ++k) {
            const auto expected = [&](Series3 EndSeries::*member) {
              return Vec3(
                  difference([&](double x) { return derivative(t.ends[i].series(x).*member, k); }, v, h));
            };
            const EndSeries s = t.ends[i].series(v);
            // h^4/30 = 5e-13 times seventh derivatives below 1e5, where the law is a quintic between its
            // points; at a point its fifth derivative jumps, which adds h^3 of that to the second difference:
            // below 1e-6.
            EXPECT_LE((derivative(s.C, k + 1) - expected(&EndSeries::C)).norm(), 1e-6);
            if (k == 2) continue;  // T and D are known to order 2
            EXPECT_LE((derivative(s.T, k + 1) - expected(&EndSeries::T)).norm(), 1e-6)
                << i << " order " << k + 1;
            EXPECT_LE((derivative(s.D, k + 1) - expected(&EndSeries::D)).norm(), 1e-6)
                << i << " order " << k + 1;
          }
      },
      40);
}

TEST(SignRule, FilletsRunOutOfPrimary0AndIntoPrimary1) {
  const CrossTangents down = tangents(coaxial(), both({}));
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 T = value(down.ends[i].series(0.3).T);
    EXPECT_LT(T[2], 0.0) << "from the upper cylinder down to the lower one, " << i;
    EXPECT_LE(T.head<2>().norm(), 1e-14);
  }
  const Correspondence corner = fillet();
  const CrossTangents out = tangents(corner, both({}));
  const Vec3 T0 = value(out.ends[0].series(0.3).T), T1 = value(out.ends[1].series(0.3).T);
  EXPECT_LT(T0[2], 0.0) << "down the cylinder";
  EXPECT_GT(T1.dot(corner.line1.jet(0.3).C()), 0.0) << "outwards on the plane";
  // The kept part of the cylinder is above: T0 points out of it; the plane's outer part is kept.
  const auto left = [](const Trimline& line, double v) {
    return Vec3(unit_normal(primary_jet(line, v)).cross(line.jet(v).C1()));
  };
  EXPECT_EQ(out.kept_left[0], left(corner.line0, 0.3)[2] > 0.0);
  EXPECT_EQ(out.kept_left[1], left(corner.line1, 0.3).dot(corner.line1.jet(0.3).C()) > 0.0);
}

TEST(SignRule, KeptSidesCanBeSaidAndFollowTheGivenLine) {
  const Trimline line0 = isoline(cylinder(1.0, 1.0, 5.0), IsoDirection::constant_u, 2.0);
  const Trimline line1(plane(9.0), ellipse(3, 3));
  for (const bool reverse : {false, true}) {
    CorrespondenceSpec spec;
    spec.reverse = reverse;
    const Correspondence lines = correspond(line0, line1, spec);
    std::array<SideSpec, 2> sides = both(side_of(MagnitudeRule::chord));
    // n x C' of the given circle in the plane (n = z, counter-clockwise) points inwards: left is the disc.
    sides[1].keep = SideSpec::Keep::left;
    EXPECT_LT(value(tangents(lines, sides).ends[1].series(0.3).T).dot(lines.line1.jet(0.3).C()), 0.0);
    sides[1].keep = SideSpec::Keep::right;
    const CrossTangents right = tangents(lines, sides);
    EXPECT_GT(value(right.ends[1].series(0.3).T).dot(lines.line1.jet(0.3).C()), 0.0);
    EXPECT_EQ(right.kept_left[1], reverse) << "kept_left speaks of the line as it runs in the blend";
    // On the cylinder n = Su x Sv points inwards, so n x C' points down: left is the lower part, T0 points up
    // out of it.
    sides[0].keep = SideSpec::Keep::left;
    const SurfaceJet s = primary_jet(line0, 0.1);
    ASSERT_LT(unit_normal(s).cross(line0.jet(0.1).C1())[2], 0.0);
    EXPECT_GT(value(tangents(lines, sides).ends[0].series(0.3).T)[2], 0.0);
  }
}

TEST(SignRule, UndecidableIsAnErrorUntilTheUserSays) {
  // Equal circles in parallel planes: the other line is straight above, at a right angle to both tangent
  // planes.
  const Surface upper = plane(9.0, RigidMotion::from_axis({0, 0, 2}, Vec3::UnitZ(), Vec3::UnitX()));
  const Correspondence lines =
      correspond(Trimline(plane(9.0), ellipse(2, 2)), Trimline(upper, ellipse(2, 2)), {});
  EXPECT_THAT(message_of([&] { (void)tangents(lines, both(side_of(MagnitudeRule::chord))); }),
              HasSubstr("say which side to keep"));
  SideSpec side = side_of(MagnitudeRule::chord);
  side.keep = SideSpec::Keep::left;
  EXPECT_NO_THROW((void)tangents(lines, both(side)));
}

TEST(TangentAngle, TurnsTheTangentTowardsTheTrimline) {
  const Correspondence lines = wild();
  std::array<SideSpec, 2> sides = both(side_of(MagnitudeRule::chord));
  sides[0].tangent_angle = degrees(25.0);
  sides[1].tangent_angle = degrees(-60.0);
  const CrossTangents t = tangents(lines, sides);
  const Vec3 a = value(t.ends[0].series(0.4).T), b = value(t.ends[1].series(0.4).T);
  EXPECT_NEAR(a.normalized().dot(lines.line0.jet(0.4).C1().normalized()), std::sin(degrees(25.0).value),
              1e-13);
  EXPECT_NEAR(b.normalized().dot(lines.line1.jet(0.4).C1().normalized()), -std::sin(degrees(60.0).value),
              1e-13);
}

TEST(Magnitude, ChordAndConstantAreWhatTheySay) {
  const Correspondence lines = wild();
  const CrossTangents t =
      tangents(lines, {side_of(MagnitudeRule::chord, 1.3), side_of(MagnitudeRule::constant, 0.4)});
  const double chord = (lines.line1.jet(0.2).C() - lines.line0.jet(0.2).C()).norm();
  EXPECT_NEAR(value(t.ends[0].series(0.2).T).norm(), 1.3 * chord, 1e-14);
  EXPECT_NEAR(value(t.ends[1].series(0.2).T).norm(), 0.4, 1e-15);
}

TEST(Magnitude, CircleLikeMakesTheCubicOfAnArc) {
  // A quarter of a circle of radius 2 between the cylinder (vertical) and the plane (radial): theta = 90 deg.
  const CrossTangents t = tangents(fillet(), both({}));
  const EndSeries a = t.ends[0].series(0.1), b = t.ends[1].series(0.1);
  const Vec3 C0 = value(a.C), C1 = value(b.C), T0 = value(a.T), T1 = value(b.T);
  const Vec3 centre =
      C0 + 2.0 * (C1 - Vec3(C1[0], C1[1], 0.0) + Vec3(C0[0], C0[1], 0.0));  // (3 cos, 3 sin, 2)
  double worst = 0.0;
  for (int i = 0; i <= 100; ++i) {
    const double u = i / 100.0, w = 1.0 - u;
    const Vec3 G =
        (1.0 + 2.0 * u) * w * w * C0 + (1.0 + 2.0 * w) * u * u * C1 + u * w * w * T0 - u * u * w * T1;
    worst = std::max(worst, std::abs((G - centre).norm() - 2.0));
  }
  // The cubic that meets a quarter arc's middle point is off by 2.73e-4 radii at most (the well-known kappa
  // 0.5523).
  EXPECT_LE(worst, 2.0 * 2.75e-4);
  EXPECT_GE(worst, 2.0 * 2.5e-4);
  EXPECT_NEAR(T0.norm(), 3.0 * 0.5522847498307936 * 2.0, 1e-12);
}

/// The cubic's length by a fine polygon, independent of the library's quadrature; error about length / (24
/// n^2).
double polygon_length(const Vec3& C0, const Vec3& T0, const Vec3& C1, const Vec3& T1) {
  constexpr int n = 4000;
  double length = 0.0;
  Vec3 last = C0;
  for (int i = 1; i <= n; ++i) {
    const double u = static_cast<double>(i) / n, w = 1.0 - u;
    const Vec3 G =
        (1.0 + 2.0 * u) * w * w * C0 + (1.0 + 2.0 * w) * u * u * C1 + u * w * w * T0 - u * u * w * T1;
    length += (G - last).norm();
    last = G;
  }
  return length;
}

TEST(Magnitude, ArcLengthIsTheLengthOfTheCubic) {
  const CrossTangents t = tangents(wild(), both(side_of(MagnitudeRule::arc_length)));
  for (int i = 0; i < 16; ++i) {
    const double v = i / 16.0;
    const EndSeries a = t.ends[0].series(v), b = t.ends[1].series(v);
    const double length = polygon_length(value(a.C), value(a.T), value(b.C), value(b.T));
    // Five passes of m <- length(m): the map contracts by about |dL/dm| < 0.4, start within 0.5 of the
    // length.
    EXPECT_NEAR(value(a.T).norm(), length, 0.5 * std::pow(0.4, 5) * length);
    EXPECT_NEAR(value(a.T).norm(), value(b.T).norm(), 1e-12) << "both sides take the same length";
  }
}

/// int |G''|^2 du of the cubic Hermite curve, by Simpson (exact: the integrand is quadratic).
double bending(const Vec3& C0, const Vec3& T0, const Vec3& C1, const Vec3& T1) {
  const auto G2 = [&](double u) {
    return Vec3((12.0 * u - 6.0) * (C0 - C1) + (6.0 * u - 4.0) * T0 + (6.0 * u - 2.0) * T1);
  };
  return (G2(0.0).squaredNorm() + 4.0 * G2(0.5).squaredNorm() + G2(1.0).squaredNorm()) / 6.0;
}

/// A cylinder above an ellipse in a plane.
Correspondence uneven_fillet() {
  return correspond(isoline(cylinder(1.0, 1.0, 5.0), IsoDirection::constant_u, 2.0),
                    Trimline(plane(9.0), ellipse(3.0, 2.4, 0.3, 0.1)), {});
}

TEST(Magnitude, MinimumBendingCannotBeImproved) {
  const CrossTangents t = tangents(uneven_fillet(), both(side_of(MagnitudeRule::minimum_bending)));
  for (int i = 0; i < 16; ++i) {
    const double v = i / 16.0;  // places where the spline of the ratios interpolates
    const EndSeries a = t.ends[0].series(v), b = t.ends[1].series(v);
    const auto energy = [&](double s, double r) {
      return bending(value(a.C), (1.0 + s) * value(a.T), value(b.C), (1.0 + r) * value(b.T));
    };
    const double chord = (value(b.C) - value(a.C)).norm();
    ASSERT_GT(value(a.T).norm(), 0.11 * chord) << "not clamped here";
    ASSERT_GT(value(b.T).norm(), 0.11 * chord) << "not clamped here";
    for (const double s : {-1e-3, 0.0, 1e-3})
      for (const double r : {-1e-3, 0.0, 1e-3}) {
        if (s == 0.0 && r == 0.0) continue;
        EXPECT_GT(energy(s, r), energy(0.0, 0.0));
      }
  }
}

TEST(Magnitude, MinimumBendingStaysInItsBounds) {
  // The plane's tangent, forced inwards, points away from the other line: the free optimum would be negative.
  std::array<SideSpec, 2> sides = both(side_of(MagnitudeRule::minimum_bending));
  sides[1].keep = SideSpec::Keep::left;
  const CrossTangents t = tangents(fillet(), sides);
  const EndSeries a = t.ends[0].series(0.25), b = t.ends[1].series(0.25);
  EXPECT_NEAR(value(b.T).norm(), 0.1 * (value(b.C) - value(a.C)).norm(), 1e-12);
  // The other magnitude is still the best one beside this.
  const auto energy = [&](double s) {
    return bending(value(a.C), (1.0 + s) * value(a.T), value(b.C), value(b.T));
  };
  EXPECT_GT(energy(1e-3), energy(0.0));
  EXPECT_GT(energy(-1e-3), energy(0.0));
}

TEST(Magnitude, IsReportedAt65Places) {
  const CrossTangents t = tangents(wild(), both(side_of(MagnitudeRule::arc_length, 1.1)));
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(t.magnitude[i].size(), 65u);
    for (std::size_t k = 0; k < 65; ++k)
      EXPECT_NEAR(t.magnitude[i][k], value(t.ends[i].series(static_cast<double>(k) / 64.0).T).norm(), 1e-13);
  }
}

TEST(FactorLaw, PassesThroughItsPointsAndIsPeriodicOnClosedLines) {
  for (const std::vector<LawPoint>& points :
       {std::vector<LawPoint>{{0.0, 1.0}, {0.5, 1.4}},
        {{0.1, 1.0}, {0.4, 1.4}, {0.8, 0.7}},
        {{0.0, 1.0}, {0.2, 1.1}, {0.3, 1.3}, {0.5, 1.0}, {0.6, 0.8}, {0.7, 0.8}, {0.9, 0.9}, {1.0, 1.0}}}) {
    SideSpec side = side_of(MagnitudeRule::constant);
    side.factor = points;
    const CrossTangents t = tangents(coaxial(), both(side));
    const auto m = [&](double v) { return t.ends[0].series(v).T[2]; };  // T = (0, 0, -m)
    for (const LawPoint& p : points) EXPECT_NEAR(-m(p.t).value(), p.value, 1e-13);
    for (int k = 0; k <= 2; ++k)
      // Rounding of second derivatives of splines with steps of 0.1: eps * 1e2 * a few.
      EXPECT_NEAR(m(0.0).derivative(k), m(1.0).derivative(k), 1e-10) << "C2 across the seam, order " << k;
    for (const LawPoint& p : points)
      for (int k = 0; k <= 2; ++k)
        // Steps of 1e-9 to both sides of a knot: a jump would stay, the slope moves by 2e-9 * third
        // derivative.
        EXPECT_NEAR(m(p.t + 1e-9).derivative(k), m(p.t - 1e-9 + (p.t == 0.0 ? 1.0 : 0.0)).derivative(k),
                    1e-5);
  }
}

TEST(FactorLaw, OfTwoPointsIsAStraightLineOnOpenLines) {
  const Surface low = plane(9.0),
                high = plane(9.0, RigidMotion::from_axis({0, 3, 2}, Vec3(0, -1, 1), Vec3::UnitX()));
  const Correspondence lines =
      correspond(isoline(low, IsoDirection::constant_v, 0.0, Interval{0.0, 4.0}),
                 isoline(high, IsoDirection::constant_v, 0.0, Interval{0.0, 4.0}), {});
  SideSpec side = side_of(MagnitudeRule::constant);
  side.factor = {{0.0, 1.0}, {1.0, 2.0}};
  const CrossTangents t = tangents(lines, both(side));
  for (const double v : {0.0, 0.3, 1.0}) EXPECT_NEAR(value(t.ends[0].series(v).T).norm(), 1.0 + v, 1e-13);
  side.factor = {{0.25, 1.0}, {0.75, 2.0}};
  const CrossTangents held = tangents(lines, both(side));
  EXPECT_NEAR(value(held.ends[0].series(0.0).T).norm(), 1.0, 1e-13) << "the first value holds at the start";
  EXPECT_NEAR(value(held.ends[0].series(1.0).T).norm(), 2.0, 1e-13);
}

TEST(G0, FollowsTheChordAndAsksNoTangency) {
  const Correspondence lines = wild();
  const CrossTangents t = tangents(lines, both(side_of(MagnitudeRule::chord, 1.5, Continuity::G0)));
  const EndSeries a = t.ends[0].series(0.6), b = t.ends[1].series(0.6);
  EXPECT_LE((value(a.T) - 1.5 * (value(b.C) - value(a.C))).norm(), 1e-14);
  EXPECT_EQ(t.ends[0].continuity, Continuity::G0);
  // It also works where the primary has no tangent plane: a trimline round a pole.
  const Correspondence pole = correspond(
      isoline(cylinder(1.0, 1.0, 5.0), IsoDirection::constant_u, 2.0),
      isoline(formula({"u*cos(v)*0.5", "u*sin(v)*0.5", "0*u"}, {-1, 1}, {0.0, 2.0 * pi}, {false, true}),
              IsoDirection::constant_u, 1.0),
      {});
  EXPECT_NO_THROW((void)tangents(pole, both(side_of(MagnitudeRule::chord, 1.0, Continuity::G0))));
}

TEST(CrossTangents, EndsAreTheSameInAnyOrderOfAsking) {
  const Correspondence lines = wild();
  const CrossTangents a = tangents(lines, both({})), b = tangents(coaxial(), both({}));
  const EndSeries first = a.ends[0].series(0.3);
  (void)a.ends[1].series(0.7);
  (void)b.ends[0].series(0.3);
  const EndSeries again = a.ends[0].series(0.3);
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_EQ(first.C[d].c, again.C[d].c);
    EXPECT_EQ(first.T[d].c, again.T[d].c);
  }
}

TEST(CrossTangents, ContinueThroughAHarmlessPole) {
  // (u, w^3, 0.1 u^2): |Su x Sv| = 0 at w = 0, where the trimline passes with both normals in agreement.
  const Surface folded = formula({"u", "v^3", "0.1*u^2"}, {-1.0, 1.0}, {-1.0, 1.0});
  const Curve2 diagonal = curve<2>([](const auto& v) { return std::array{v, 1.0 * v}; }, {-0.8, 0.9});
  const Trimline line0(folded, diagonal);
  const Trimline line1 = isoline(plane(9.0, RigidMotion::from_axis({0, 3, 2}, Vec3(0, -1, 1), Vec3::UnitX())),
                                 IsoDirection::constant_v, 0.0, Interval{-1.0, 1.0});
  CorrespondenceSpec spec;
  spec.rule = CorrespondenceRule::as_given;
  const CrossTangents t = tangents(correspond(line0, line1, spec), both(side_of(MagnitudeRule::constant)));
  // The surface is (x, y, x^2/10): at x = 0 the normal is z and C' = (1, 0, 0), so T = +-(0, 1, 0).
  const Vec3 T = value(t.ends[0].series(0.0).T);
  EXPECT_LE((T - Vec3(0, 1, 0)).norm(),
            1e-6);  // continued over h = 1.7e-3 with error h^3 and third derivatives of 6^2
  for (int i = -20; i <= 20; ++i) EXPECT_TRUE(value(t.ends[0].series(1e-4 * i).T).allFinite());
}

TEST(CrossTangents, RefuseWhatHasNoTangent) {
  CorrespondenceSpec given;
  given.rule = CorrespondenceRule::as_given;
  const Curve2 cusp = curve<2>([](const auto& v) { return std::array{v * v, v * v * v}; }, {-1.0, 1.0});
  const Trimline above =
      isoline(plane(9.0, RigidMotion::from_axis({0, 0, 2}, Vec3(0.2, 0.1, 1), Vec3::Zero())),
              IsoDirection::constant_v, 0.0, Interval{-1.0, 1.0});
  const std::string what =
      message_of([&] { (void)tangents(correspond(Trimline(plane(5.0), cusp), above, given), both({})); });
  EXPECT_THAT(what, HasSubstr("from: the trimline stops (|C'| = 0) at v = "));
  EXPECT_THAT(what, HasSubstr("split the blend there"));
}

TEST(CrossTangents, RefuseTrimlinesThatTouch) {
  const Correspondence lines = correspond(isoline(cylinder(1.0, -1.0, 5.0), IsoDirection::constant_u, 2e-5),
                                          Trimline(plane(9.0), ellipse(1.0 + 5e-5, 1.0 + 5e-5)), {});
  EXPECT_THAT(message_of([&] { (void)cross_tangents(lines, both({}), 1e-6); }),
              HasSubstr("the trimlines touch at v = 0"));
  EXPECT_NO_THROW((void)cross_tangents(lines, both(side_of(MagnitudeRule::chord)), 1e-7));
}

TEST(CrossTangents, RefuseCircleLikeHairpins) {
  // Coaxial cylinders side by side: down on the inner one, up on the outer one, theta = 180 deg.
  const Correspondence lines =
      correspond(isoline(cylinder(1.0, -1.0, 5.0), IsoDirection::constant_u, 0.0),
                 isoline(cylinder(2.0, -1.0, 5.0), IsoDirection::constant_u, 0.01), {});
  std::array<SideSpec, 2> sides = both({});
  sides[0].keep = SideSpec::Keep::right;
  sides[1].keep = SideSpec::Keep::right;
  EXPECT_NO_THROW((void)tangents(lines, both(side_of(MagnitudeRule::chord))));
  const std::string one = message_of([&] { (void)tangents(lines, sides); });
  EXPECT_THAT(one, HasSubstr("turn by 180 deg at v = 0 (1, 0, 0)"));
  sides[0].rule = sides[1].rule = MagnitudeRule::chord;
  EXPECT_NO_THROW((void)tangents(lines, sides));
}

TEST(SideSpec, ProblemsAreListedTogetherWithTheirPlaces) {
  std::array<SideSpec, 2> sides = both({});
  sides[0].factor = {{0.0, -1.0}};
  sides[0].tangent_angle = degrees(61.0);
  sides[1].factor = {{0.5, 1.0}, {1.5, 1.0}, {0.2, 1.0}};
  sides[1].continuity = Continuity::none;
  try {
    (void)tangents(coaxial(), sides);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    std::vector<std::string> where;
    for (const Problem& p : e.problems()) where.push_back(p.where);
    EXPECT_THAT(where, ::testing::ElementsAre("sides/0/factor/0", "sides/0/tangent_angle",
                                              "sides/1/continuity", "sides/1/factor/1", "sides/1/factor/2"));
  }
  const auto law = [&](std::vector<LawPoint> points) {
    SideSpec side;
    side.factor = std::move(points);
    return message_of([&] { (void)tangents(coaxial(), both(side)); });
  };
  EXPECT_THAT(law({}), HasSubstr("is empty"));
  EXPECT_THAT(law({{0.0, 1.0}, {1.0, 2.0}}), HasSubstr("same point of a closed trimline"));
  EXPECT_THAT(law({{0.0, 5.0}, {0.3, 0.05}, {0.7, 0.05}}), HasSubstr("between its points"));
  EXPECT_EQ(law({{0.0, 1.0}, {0.5, 2.0}, {1.0, 1.0}}), "no error");
}

TEST(LiteralEnd, HasTheDerivativesOfItsFormulas) {
  const EndCondition end = literal_end({{"-r*cos(v)", "r*sin(v)", "v^2"}, {"0", "0", "-2*v"}, {}},
                                       {{0.0, 2.0 * pi}, false}, {{"r", 1.5}});
  EXPECT_EQ(end.continuity, Continuity::G1);
  const EndSeries s = end.series(0.7);
  EXPECT_LE((derivative(s.C, 3) - Vec3(-1.5 * std::sin(0.7), -1.5 * std::cos(0.7), 0.0)).norm(), 1e-14);
  EXPECT_LE((derivative(s.C, 2) - Vec3(1.5 * std::cos(0.7), -1.5 * std::sin(0.7), 2.0)).norm(), 1e-14);
  EXPECT_EQ(derivative(s.T, 1), Vec3(0, 0, -2));
  EXPECT_EQ(value(s.D), Vec3::Zero());
  const EndCondition g2 =
      literal_end({{"v", "0", "0"}, {"0", "1", "0"}, {"0", "0", "v"}}, {{0.0, 1.0}, false}, {});
  EXPECT_EQ(g2.continuity, Continuity::G2);
  EXPECT_EQ(value(g2.series(0.5).D), Vec3(0, 0, 0.5));
}

TEST(LiteralEnd, NamesEveryBadText) {
  try {
    (void)literal_end({{"v", "sin(", "0"}, {"0", "0"}, {"0", "0", "r*v"}}, {{1.0, 0.0}, false}, {});
    FAIL() << "accepted";
  } catch (const InputError& e) {
    std::vector<std::string> where;
    for (const Problem& p : e.problems()) where.push_back(p.where);
    EXPECT_THAT(where, ::testing::ElementsAre("v", "C/1", "T", "D/2"));
  }
}

}  // namespace
}  // namespace blendwright
