#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/geometry/curvature.hpp"
#include "parametric/blend.hpp"
#include "tests/parametric/sample_lines.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using namespace test;
using ::testing::HasSubstr;

constexpr double tolerance = 1e-6;

Trimline upper(double angle = 0.0, bool backwards = false) {
  const Vec3 axis = backwards ? Vec3(-Vec3::UnitZ()) : Vec3(Vec3::UnitZ());
  const auto placement = RigidMotion::from_axis({0, 0, 2}, axis, {std::cos(angle), std::sin(angle), 0.0});
  return isoline(cylinder(1.0, -2.0, 2.0, placement), IsoDirection::constant_u, 0.0);
}
Trimline lower() { return isoline(cylinder(2.0, -5.0, 1.0), IsoDirection::constant_u, 0.0); }
/// A wavy line on a torus and an ellipse on a free surface above it.
Trimline on_torus() {
  return Trimline(torus(3.0, 1.0), curve<2>(
                                       [](const auto& v) {
                                         return std::array{1.4 + 0.2 * sin(2.0 * v), v + 0.1 * cos(v)};
                                       },
                                       {0.0, 2.0 * pi}, true));
}
Trimline on_roof() {
  return Trimline(formula({"u", "v", "3 + 0.1*u^2 - 0.05*u*v + 0.2*sin(v)"}, {-3.0, 3.0}, {-3.0, 3.0}),
                  ellipse(1.5, 1.2, 0.1, 0.2));
}
BlendSpec spec_of(Continuity continuity) {
  BlendSpec spec;
  spec.sides[0].continuity = spec.sides[1].continuity = continuity;
  spec.shape.tension = 1.5;
  spec.shape.ode = {SweepOde{1.0, -5.0, 6.25}, SweepOde{1.0, -5.0, 6.25}, SweepOde{1.0, -5.0, 6.25}};
  return spec;
}

/// Position, tangent plane and normal curvature across both trimlines, measured from the primaries alone.
void expect_joined(const Blend& blend, bool curvature) {
  for (int side = 0; side < 2; ++side) {
    const Trimline& line = *blend.trimlines[static_cast<std::size_t>(side)];
    for (int i = 0; i < 40; ++i) {
      const double v = line.domain().v.at(i / 40.0);
      const Vec2 p = line.pcurve().point(v);
      const SurfaceJet primary = line.primary().jet({p[0], p[1]});
      const SurfaceJet s = blend.surface.jet({static_cast<double>(side), v});
      const Vec3 n = unit_normal(primary);
      EXPECT_LE((s.S - primary.S).norm(), 1e-12);
      EXPECT_LE(plane_angle(unit_normal(s), n).value, 1e-12);
      if (!curvature) continue;
      // Second derivatives of size 10 divided by |Su|^2 of size 1: rounding of 1e-15 * 1e2.
      EXPECT_NEAR(normal_curvature(s, s.Su, n), normal_curvature(primary, s.Su, n), 1e-11);
    }
  }
}

TEST(MakeBlend, MeetsCoaxialCylinders) {
  expect_joined(make_blend(upper(), lower(), spec_of(Continuity::G1), tolerance), false);
  expect_joined(make_blend(upper(), lower(), spec_of(Continuity::G2), tolerance), true);
}

TEST(MakeBlend, MeetsFreePrimariesWithEveryRule) {
  for (const MagnitudeRule rule :
       {MagnitudeRule::chord, MagnitudeRule::circle_like, MagnitudeRule::arc_length,
        MagnitudeRule::minimum_bending, MagnitudeRule::constant})
    for (const CorrespondenceRule correspondence :
         {CorrespondenceRule::as_given, CorrespondenceRule::arc_length, CorrespondenceRule::minimal_twist}) {
      BlendSpec spec = spec_of(Continuity::G2);
      spec.sides[0].rule = spec.sides[1].rule = rule;
      spec.sides[1].factor = {{0.0, 1.0}, {0.4, 1.5}};
      spec.correspondence.rule = correspondence;
      expect_joined(make_blend(on_torus(), on_roof(), spec, tolerance), true);
    }
}

TEST(MakeBlend, OfG1OnlyDoesNotMatchCurvatureByChance) {
  const Blend blend = make_blend(on_torus(), on_roof(), spec_of(Continuity::G1), tolerance);
  const SurfaceJet s = blend.surface.jet({0.0, 0.3});
  const Vec2 p = blend.trimlines[0]->pcurve().point(0.3);
  const SurfaceJet primary = on_torus().primary().jet({p[0], p[1]});
  EXPECT_GT(std::abs(normal_curvature(s, s.Su, unit_normal(primary)) -
                     normal_curvature(primary, s.Su, unit_normal(primary))),
            1e-2);
}

TEST(MakeBlend, SwappingTheSidesGivesTheSameSurface) {
  for (const Continuity c : {Continuity::G1, Continuity::G2}) {
    BlendSpec spec = spec_of(c);
    const Blend there = make_blend(upper(0.4), lower(), spec, tolerance);
    const Blend back = make_blend(lower(), upper(0.4), spec, tolerance);
    // Line 0 runs from its own start in both: there v = 0 is at 0.4 rad, back it is at angle 0.
    const double shift = 0.4 / (2.0 * pi);
    for_all([&](Rng& rng) {
      const double u = uniform(rng, 0.0, 1.0), v = uniform(rng, 0.0, 1.0);
      EXPECT_LE(
          (there.surface.jet({u, v}).S - back.surface.jet({1.0 - u, std::fmod(v + shift, 1.0)}).S).norm(),
          1e-10);
    });
  }
}

TEST(MakeBlend, DoesNotDependOnSeamOrDirectionOfLine1) {
  const Blend plain = make_blend(upper(), lower(), spec_of(Continuity::G2), tolerance);
  for_all(
      [&](Rng& rng) {
        const double angle = uniform(rng, 0.0, 2.0 * pi);
        const bool backwards = integer(rng, 0, 1) == 1;
        BlendSpec spec = spec_of(Continuity::G2);
        const Blend other = make_blend(lower(), upper(angle, backwards), spec, tolerance);
        const double u = uniform(rng, 0.0, 1.0), v = uniform(rng, 0.0, 1.0);
        EXPECT_LE((plain.surface.jet({u, v}).S - other.surface.jet({1.0 - u, v}).S).norm(), 1e-10);
      },
      30);
}

TEST(MakeBlend, ReversesBothLinesIntoTheSameSurface) {
  const Blend plain = make_blend(upper(), lower(), spec_of(Continuity::G1), tolerance);
  const Blend other = make_blend(upper(0.0, true), lower(), spec_of(Continuity::G1), tolerance);
  EXPECT_TRUE(other.correspondence->reversed);
  for (const double v : {0.0, 0.2, 0.7})
    EXPECT_LE((plain.surface.jet({0.4, v}).S - other.surface.jet({0.4, 1.0 - v}).S).norm(), 1e-10);
}

TEST(MakeBlend, IsQuietWhenNothingIsWrong) {
  EXPECT_THAT(make_blend(upper(), lower(), spec_of(Continuity::G2), tolerance).warnings,
              ::testing::IsEmpty());
}

TEST(MakeBlend, WarnsNearAResonance) {
  BlendSpec spec = spec_of(Continuity::G1);
  spec.shape.ode.fill(SweepOde{1.0, 0.0, -500.56});
  const Blend blend = make_blend(upper(), lower(), spec, tolerance);
  ASSERT_EQ(blend.warnings.size(), 1u);
  EXPECT_THAT(blend.warnings[0], HasSubstr("near a resonance"));
}

TEST(MakeBlend, WarnsWhenTheChordRunsAlongTheTrimline) {
  // Equal circles one above the other, joined 0.01 turns off: the chord leans by 0.0628 along them. Against a
  // gap of 1 that is harmless, against 0.001 the sine is about 0.03.
  BlendSpec spec = spec_of(Continuity::G0);
  spec.correspondence.seam_offset = 0.01;
  const Surface s = cylinder(1.0, -1.0, 1.0);
  const auto warnings = [&](double gap) {
    return make_blend(isoline(s, IsoDirection::constant_u, gap), isoline(s, IsoDirection::constant_u, 0.0),
                      spec, tolerance)
        .warnings;
  };
  EXPECT_THAT(warnings(1.0), ::testing::IsEmpty());
  EXPECT_THAT(warnings(0.001), ::testing::Contains(HasSubstr("nearly parallel")));
}

TEST(MakeBlend, WarnsOfATwistedCorrespondence) {
  BlendSpec spec = spec_of(Continuity::G1);
  spec.correspondence.reverse = true;
  EXPECT_THAT(make_blend(upper(), lower(), spec, tolerance).warnings,
              ::testing::Contains(HasSubstr("twisted")));
}

TEST(MakeBlend, WarnsOfHarmlessDegeneratePointsAndRefusesCorners) {
  const Trimline above = isoline(plane(9.0, RigidMotion::from_axis({0, 3, 2}, Vec3(0, -1, 1), Vec3::UnitX())),
                                 IsoDirection::constant_v, 0.0, Interval{-1.0, 1.0});
  BlendSpec spec = spec_of(Continuity::G1);
  spec.correspondence.rule = CorrespondenceRule::as_given;
  const Surface folded = formula({"u", "v^3", "0.1*u^2"}, {-1.0, 1.0}, {-1.0, 1.0});
  const Curve2 diagonal = curve<2>([](const auto& v) { return std::array{v, 1.0 * v}; }, {-0.8, 0.9});
  const Blend blend = make_blend(Trimline(folded, diagonal), above, spec, tolerance);
  ASSERT_EQ(blend.warnings.size(), 1u);
  EXPECT_THAT(blend.warnings[0], HasSubstr("from: the trimline passes a pole of its primary"));

  const Surface cone = formula({"1.2*u*cos(v)", "1.2*u*v*sin(v)", "2*u"}, {0.1, 1.0}, {0.0, 2.0 * pi});
  const Trimline cusp(cone, curve<2>(
                                [](const auto& v) {
                                  return std::array{0.0 * v + 0.3, v};
                                },
                                {0.0, 2.0 * pi}, true));
  const std::string what = message_of([&] { (void)make_blend(cusp, lower(), spec, tolerance); });
  EXPECT_THAT(what, HasSubstr("from: the trimline "));
  EXPECT_THAT(what, HasSubstr("at v = 0 (0.36, 0, 0.6) with a corner of"));
  EXPECT_THAT(what, HasSubstr("split the blend there"));
}

TEST(MakeBlend, ErrorsOfTheInputSayWhichPart) {
  const auto where = [](const BlendSpec& spec) {
    try {
      (void)make_blend(upper(), lower(), spec, tolerance);
    } catch (const InputError& e) {
      return e.problems().front().where;
    }
    return std::string("no error");
  };
  BlendSpec spec = spec_of(Continuity::G1);
  spec.sides[1].factor = {{0.0, 0.0}};
  EXPECT_EQ(where(spec), "sides/1/factor/0");
  spec = spec_of(Continuity::G1);
  spec.shape.ode[0].b = 0.0;
  EXPECT_THAT(where(spec), ::testing::StartsWith("shape/"));
  spec = spec_of(Continuity::G1);
  spec.correspondence.seam_offset = INFINITY;
  EXPECT_EQ(where(spec), "correspondence/seam_offset");
  EXPECT_EQ(where(spec_of(Continuity::G1)), "no error");
}

TEST(MakeLiteralBlend, AcceptsTheIrregularConeWithAWarning) {
  const CurveDomain range{{0.0, 2.0 * pi}, false};
  const EndCondition end0 = literal_end(
      {{"0.36*cos(v)", "0.36*v*sin(v)", "0.6"}, {"-1.2*cos(v)", "-1.2*v*sin(v)", "-2"}, {}}, range, {});
  const EndCondition end1 =
      literal_end({{"1 + 0.8*cos(v)", "0.6*sin(v)", "-1.9"}, {"0", "0", "-1"}, {}}, range, {});
  const Blend blend = make_literal_blend(end0, end1, spec_of(Continuity::G1).shape);
  ASSERT_EQ(blend.warnings.size(), 1u);
  EXPECT_THAT(blend.warnings[0],
              HasSubstr("from: the boundary curve stops (|C'| = 0) at v = 0 (0.36, 0, 0.6)"));
  EXPECT_FALSE(blend.correspondence);
  EXPECT_LE((blend.surface.jet({1.0, 1.0}).S - derivative(end1.series(1.0).C, 0)).norm(), 1e-13);
}

TEST(MakeLiteralBlend, WarnsOfTangentsAlongTheCurve) {
  const CurveDomain range{{0.0, 1.0}, false};
  const EndCondition end0 = literal_end({{"v", "0", "0"}, {"1", "0.05", "0"}, {}}, range, {});
  const EndCondition end1 = literal_end({{"v", "1", "0"}, {"1", "0.2", "0"}, {}}, range, {});
  const Blend blend = make_literal_blend(end0, end1, {});
  ASSERT_EQ(blend.warnings.size(), 1u);
  EXPECT_THAT(blend.warnings[0], HasSubstr("from: the cross tangent is nearly parallel"));
}

}  // namespace
}  // namespace blendwright
