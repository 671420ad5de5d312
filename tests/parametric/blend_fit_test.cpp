#include "parametric/fit/blend_fit.hpp"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stop_token>

#include "kernel/geometry/curvature.hpp"
#include "parametric/fit/span_plan.hpp"

namespace blendwright {
namespace {

using std::numbers::pi;

struct Line {
  double radius, height, wobble;
  Vec3 centre;
  Continuity continuity = Continuity::G1;
};

// A ring, or the open part v in [0.3, 2], with a cross tangent and a second derivative that turn with it.
EndCondition ring(const Line& line, bool closed = true) {
  EndCondition end;
  end.domain = closed ? CurveDomain{{0.0, 2.0 * pi}, true} : CurveDomain{{0.3, 2.0}, false};
  end.continuity = line.continuity;
  end.series = [line](double v) {
    const Series t = Series::variable(v), c = cos(t), s = sin(t),
                 r = line.radius + line.wobble * cos(3.0 * t);
    EndSeries e;
    e.C = {line.centre[0] + r * c, line.centre[1] + r * s, Series(line.height)};
    e.T = {0.3 * c, 0.3 * s, 1.0 + 0.2 * c};
    e.D = {0.5 * c, 0.4 * s, Series(0.1)};
    return e;
  };
  return end;
}

OdeBlend joint(const BlendShape& shape, Continuity at0 = Continuity::G1, Continuity at1 = Continuity::G1,
               bool closed = true) {
  return {ring({0.5, 0.0, 0.0, Vec3::Zero(), at0}, closed), ring({0.8, 1.0, 0.05, {0.1, 0, 0}, at1}, closed),
          shape};
}

BlendShape isotropic(double q, BlendMode mode = BlendMode::chord) {
  BlendShape shape;
  shape.mode = mode;
  shape.repeated_root = q;
  shape.anchor = {1.0, -2.0, 3.0};
  return shape;
}

BlendShape three_equations(BlendFrame frame) {
  BlendShape shape;
  shape.ode = {SweepOde{1, -3, 2}, SweepOde{1, -30, 0}, SweepOde{1, 2, 30}};  // regimes A, D+, F
  shape.frame = frame;
  shape.axes = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return shape;
}

BlendShape sixth(SixthOrderFamily family, double tension) {
  BlendShape shape;
  shape.family = family;
  shape.tension = tension;
  return shape;
}

BlendShape common(const SweepOde& ode) {
  BlendShape shape;
  shape.ode.fill(ode);
  return shape;
}

struct Case {
  const char* name;
  OdeBlend blend;
};

std::vector<Case> all_cases() {
  const Continuity G1 = Continuity::G1, G2 = Continuity::G2;
  return {{"cubic", joint(isotropic(0.0))},
          {"chord", joint(isotropic(1.6))},
          {"origin", joint(isotropic(1.6, BlendMode::origin))},
          {"anchor", joint(isotropic(4.0, BlendMode::anchor))},
          {"stiff", joint(isotropic(200.0))},
          {"open", joint(isotropic(2.0), G1, G1, false)},
          {"regime C", joint(common({1, 30, 100}))},
          {"regime B", joint(common({1, 0, -300}))},
          {"three equations", joint(three_equations(BlendFrame::global))},
          {"fixed frame", joint(three_equations(BlendFrame::fixed))},
          {"moving frame", joint(three_equations(BlendFrame::moving))},
          {"moving frame, open", joint(three_equations(BlendFrame::moving), G1, G1, false)},
          {"quintic", joint(sixth(SixthOrderFamily::quintic, 0.0), G2, G2)},
          {"tension1", joint(sixth(SixthOrderFamily::tension1, 5.0), G2, G2)},
          {"tension2, one end", joint(sixth(SixthOrderFamily::tension2, 20.0), G2, G1)},
          {"triple, open", joint(sixth(SixthOrderFamily::triple, 3.0), G1, G2, false)}};
}

double largest_distance(const OdeBlend& blend, const BSplineSurface& surface, int steps) {
  double worst = 0.0;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const UV p{static_cast<double>(i) / steps, blend.domain().v.at(static_cast<double>(j) / steps)};
      worst = std::max(worst, (blend.jet(p).S - surface.jet(p).S).norm());
    }
  return worst;
}

TEST(BlendFit, PositionBoundHoldsOnADenseSampling) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(c.name);
    const BlendFit fit = fit_blend(c.blend, {});
    const double measured = largest_distance(c.blend, fit.surface, 317);  // 101,124 points
    EXPECT_LE(measured, fit.report.position_bound);
    EXPECT_LE(fit.report.position_bound, 1e-7);
    EXPECT_EQ(fit.report.control_points, fit.surface.basis_u().count() * fit.surface.basis_v().count());
    // Negative control: a net that is off by ten times the bound at one control value near the middle is
    // caught.
    std::vector<Vec3> control = fit.surface.control();
    control[control.size() / 2].x() += 10.0 * fit.report.position_bound;
    const BSplineSurface moved(fit.surface.basis_u(), fit.surface.basis_v(), control);
    EXPECT_GT(largest_distance(c.blend, moved, 317), fit.report.position_bound);
  }
}

TEST(BlendFit, BoundIsNotWastefulWhereBothErrorsCount) {
  // Each direction may use half of the tolerance and the two peaks need not meet; 1.91 is the factor for the
  // samples.
  for (double q : {1.6, 5.0}) {
    const OdeBlend blend = joint(isotropic(q));
    const BlendFit fit = fit_blend(blend, {});
    EXPECT_LE(fit.report.position_bound, 8.0 * largest_distance(blend, fit.surface, 150));
  }
}

TEST(BlendFit, KeepsTangentPlanesAndCurvaturesAtTheTrimlines) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(c.name);
    const BlendFitOptions options;
    const BlendFit fit = fit_blend(c.blend, options);
    double angle = 0.0, curvature = 0.0;
    for (int side : {0, 1})
      for (int j = 0; j <= 5000; ++j) {
        const UV p{static_cast<double>(side), c.blend.domain().v.at(j / 5000.0)};
        const SurfaceJet exact = c.blend.jet(p), spline = fit.surface.jet(p);
        const Vec3 n = unit_normal(exact), across = n.cross(exact.Sv);
        angle = std::max(angle, plane_angle(n, unit_normal(spline)).value);
        if (c.blend.end(side).continuity == Continuity::G2)
          curvature = std::max(
              curvature, std::abs(normal_curvature(exact, across, n) - normal_curvature(spline, across, n)));
      }
    EXPECT_LE(angle, options.angle.value);
    EXPECT_LE(curvature, options.curvature);
    // The estimates come from five samples per span: the true maximum is at most 2.2 times as large (the
    // Lebesgue constant of five Chebyshev points of quartic and quintic derivatives is below that), and 1e-14
    // for rounding.
    EXPECT_LE(angle, 2.2 * fit.report.angle_estimate.value + 1e-14);
    EXPECT_LE(curvature, 2.2 * fit.report.curvature_estimate + 1e-11);
    EXPECT_GT(fit.report.angle_estimate.value, 0.0);
  }
}

TEST(BlendFit, IsExactAtTheTrimlinesWhereVIsABreak) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(c.name);
    const BSplineSurface surface = fit_blend(c.blend, {}).surface;
    for (double v : {surface.basis_v().breaks()[0], surface.basis_v().breaks()[3]})
      for (double u : {0.0, 1.0}) {
        const SurfaceJet exact = c.blend.jet({u, v}), spline = surface.jet({u, v});
        EXPECT_LE((exact.S - spline.S).norm(), 1e-13);
        // Differences of control values over an end span h: rounding eps/h and eps/h^2 of values of size 1.
        const double h = surface.basis_u().breaks()[1];
        EXPECT_LE((exact.Su - spline.Su).norm(), 1e-13 / h);
        EXPECT_LE((exact.Suu - spline.Suu).norm(), 1e-12 / (h * h));
      }
  }
}

TEST(BlendFit, OfAClosedBlendIsOneSmoothPeriodicFace) {
  const OdeBlend blend = joint(isotropic(1.6));
  const BSplineSurface surface = fit_blend(blend, {}).surface;
  EXPECT_TRUE(surface.domain().v_closed);
  EXPECT_TRUE(surface.basis_v().periodic());
  EXPECT_EQ(surface.domain().v, blend.domain().v);
  const double v = blend.domain().v.hi;
  for (double u : {0.0, 0.37, 1.0}) {
    const SurfacePartials before = surface.partials({u, std::nextafter(v, 0.0)}),
                          after = surface.partials({u, v});
    // One rounding of v (1e-15) times the next derivative, which is of size 1 along a ring; spans of 0.1
    // amplify rounding of the fourth difference to eps/h^4.
    for (int l = 0; l <= 4; ++l) EXPECT_LE((before(0, l) - after(0, l)).norm(), 1e-10) << l;
  }
}

TEST(BlendFit, OfAnOpenBlendKeepsTheEndDerivatives) {
  const OdeBlend blend = joint(isotropic(2.0), Continuity::G1, Continuity::G1, false);
  const BSplineSurface surface = fit_blend(blend, {}).surface;
  EXPECT_FALSE(surface.domain().v_closed);
  for (double v : {0.3, 2.0})
    for (double u : {0.0, 1.0}) {
      const SurfaceJet exact = blend.jet({u, v}), spline = surface.jet({u, v});
      EXPECT_LE((exact.Sv - spline.Sv).norm(), 1e-12);
      EXPECT_LE((exact.Suv - spline.Suv).norm(), 1e-12);
      EXPECT_LE((exact.Svv - spline.Svv).norm(), 1e-10);
    }
}

TEST(BlendFit, NeedsControlPointsLikeTheCubeRootOfTheTolerance) {
  // Order 6 in both directions: count ~ tolerance^(-2/6).
  const auto controls = [](double position) {
    BlendFitOptions options;
    options.position = position;
    options.angle = degrees(1.0);
    return static_cast<double>(fit_blend(joint(isotropic(3.0)), options).report.control_points);
  };
  const double slope = std::log10(controls(1e-11) / controls(1e-8)) / 3.0;
  EXPECT_NEAR(slope, 1.0 / 3.0, 0.08);
}

TEST(BlendFit, StaysSmallAtTheUsualTolerances) {
  // Half of what a joint of size 1 is asked for: gap 1e-6, angle 1e-3 deg, curvature jump 1e-4.
  BlendFitOptions options;
  options.position = 5e-7;
  options.angle = degrees(5e-4);
  options.curvature = 5e-5;
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(c.name);
    EXPECT_LE(fit_blend(c.blend, options).report.control_points, 2000);
  }
}

TEST(BlendFit, HoldsItsBoundForTrimlinesOfLowSmoothness) {
  // |sin|^3 has a jump of its third derivative at 0 and pi: the breaks gather there.
  EndCondition kinked = ring({0.8, 1.0, 0.0, Vec3::Zero()});
  kinked.series = [smooth = kinked.series](double v) {
    EndSeries e = smooth(v);
    const Series s = sin(Series::variable(v)), bump = (std::sin(v) < 0.0 ? -0.05 : 0.05) * s * s * s;
    e.C[2] = e.C[2] + bump;
    return e;
  };
  const OdeBlend blend(ring({0.5, 0.0, 0.0, Vec3::Zero()}), kinked, isotropic(1.0));
  BlendFitOptions options;
  options.position = 1e-6;
  options.angle = degrees(1e-2);
  const BlendFit fit = fit_blend(blend, options);
  EXPECT_LE(largest_distance(blend, fit.surface, 317), 1e-6);
  EXPECT_LE(fit.report.control_points, 2000);
}

TEST(BlendFit, SaysWhatItReachedWhenTheNetIsTooSmall) {
  for (const char* name : {"chord", "stiff", "moving frame"})
    for (const Case& c : all_cases()) {
      if (c.name != std::string(name)) continue;
      BlendFitOptions options;
      options.max_control_points = 120;
      try {
        (void)fit_blend(c.blend, options);
        FAIL() << name << " was accepted";
      } catch (const ConvergenceError& e) {
        EXPECT_THAT(e.what(), testing::HasSubstr("blend fit")) << name;
      }
    }
}

TEST(BlendFit, OfStiffBlendsKeepsItsBoundUntilLayersAreTooThinForSTEP) {
  // exp(-q/6) and exp(q/6) leave the range of doubles at q = 4259.
  for (const double q : {2500.0, 4250.0, 4300.0, 6000.0, 1e6, 1e9}) {
    const OdeBlend blend = joint(isotropic(q));
    const BlendFit fit = fit_blend(blend, {});
    EXPECT_LE(fit.report.position_bound, 1e-7) << q;
    const std::vector<double>& breaks = fit.surface.basis_u().breaks();
    double least = 1.0;
    for (std::size_t i = 1; i < breaks.size(); ++i) least = std::min(least, breaks[i] - breaks[i - 1]);
    EXPECT_GT(least, 0.01 / q);
    // The bound with a rounding of 1e-15, in the layers and between.
    for (const double u : {0.0, 0.3 / q, 1.0 / q, 5.0 / q, 30.0 / q, 0.5, 1.0 - 1.0 / q, 1.0})
      for (const double v : {0.1, 2.3, 4.4})
        EXPECT_LE((fit.surface.jet({u, v}).S - blend.jet({u, v}).S).norm(), 1.0001e-7) << q << " " << u;
  }
  try {
    (void)fit_blend(joint(isotropic(2e9)), {});
    FAIL() << "was accepted";
  } catch (const GeometryError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("q = 2e+09"));
    EXPECT_THAT(e.what(), testing::HasSubstr("the largest q is 1e+09"));
  }
}

TEST(BlendFit, RefusesTolerancesThatAreNotPositive) {
  const OdeBlend blend = joint(isotropic(1.0));
  EXPECT_THROW((void)fit_blend(blend, {.position = 0.0}), InputError);
  EXPECT_THROW((void)fit_blend(blend, {.angle = Radians(-1.0)}), InputError);
  EXPECT_THROW((void)fit_blend(blend, {.curvature = std::nan("")}), InputError);
  EXPECT_THROW((void)fit_blend(blend, {.max_control_points = 0}), InputError);
}

TEST(BlendFit, ReportsMonotoneProgressAndStops) {
  const OdeBlend blend = joint(isotropic(1.0));
  double last = 0.0;
  Progress progress;
  progress.report = [&](double fraction, std::string_view) {
    EXPECT_GE(fraction, last);
    last = fraction;
  };
  (void)fit_blend(blend, {}, progress);
  EXPECT_EQ(last, 1.0);
  std::stop_source source;
  source.request_stop();
  progress.stop = source.get_token();
  EXPECT_THROW((void)fit_blend(blend, {}, progress), Cancelled);
}

double largest_neighbour_ratio(const std::vector<double>& t) {
  double most = 1.0;
  for (std::size_t i = 1; i + 1 < t.size(); ++i) {
    const double r = (t[i + 1] - t[i]) / (t[i] - t[i - 1]);
    most = std::max({most, r, 1.0 / r});
  }
  return most;
}

TEST(SpanPlan, GradedBreaksAreSymmetricAndGatherInTheLayers) {
  for (double q : {0.0, 1e-9, 1.0, 20.0, 1000.0, 4300.0, 6000.0, 1e9})
    for (int n : {1, 2, 7, 40}) {
      const std::vector<double> t = detail::graded_breaks(q, n);
      EXPECT_TRUE(std::is_sorted(t.begin(), t.end()));
      // With 40 spans the layers take about 20 each; a span at the border is about 6/(20 q).
      if (n == 40 && q >= 1000.0) {
        EXPECT_GT(t[1], 0.05 / q);
        EXPECT_LT(t[1], 1.0 / q);
        EXPECT_GT(t[t.size() / 2], 0.25);
      }
      EXPECT_EQ(t.front(), 0.0);
      EXPECT_EQ(t.back(), 1.0);
      EXPECT_GE(static_cast<int>(t.size()), n + 1);
      for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(t[i] + t[t.size() - 1 - i], 1.0, 1e-15);
      EXPECT_LE(largest_neighbour_ratio(t), 4.0 * (1 + 1e-12));
    }
  const std::vector<double> even = detail::graded_breaks(0.0, 10), steep = detail::graded_breaks(50.0, 10);
  EXPECT_NEAR(even[1], 0.1, 1e-12);
  EXPECT_LT(steep[1], 0.05);
}

TEST(SpanPlan, RefinementMovesBreaksToWhereTheyAreNeeded) {
  std::vector<double> uniform;
  for (int i = 0; i <= 10; ++i) uniform.push_back(i);
  const std::vector<double> even = detail::refined_breaks(uniform, std::vector<double>(10, 1.5), false);
  for (std::size_t i = 1; i < even.size(); ++i)
    EXPECT_NEAR(even[i] - even[i - 1], 10.0 / static_cast<double>(even.size() - 1),
                1e-13);  // keeps the pattern
  EXPECT_GE(even.size(), 16u);

  std::vector<double> need(10, 0.5);
  need[0] = 4.0;
  for (bool periodic : {false, true}) {
    const std::vector<double> t = detail::refined_breaks(uniform, need, periodic);
    EXPECT_LE(t[1], 0.3);                 // 1/4 and the reserve
    EXPECT_GE(t[t.size() / 2], 1.0);      // not everywhere
    EXPECT_GT(t.size(), uniform.size());  // always progress
    EXPECT_LE(largest_neighbour_ratio(t), 4.0 * (1 + 1e-12));
    const double first = t[1] - t[0], last = t[t.size() - 1] - t[t.size() - 2];
    if (periodic) {
      EXPECT_LE(last / first, 4.0 * (1 + 1e-12));
    }
  }
}

}  // namespace
}  // namespace blendwright
