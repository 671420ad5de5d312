#include "verify/continuity/seam.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/verify/shapes.hpp"

namespace blendwright {
namespace {

using namespace test;

constexpr double eps = std::numeric_limits<double>::epsilon();
// Positions, normals and curvatures of shapes of size 1 come from some ten rounded operations each.
constexpr double rounding = 50.0 * eps;

Tolerance tight() { return {1e-12, Radians(1e-12), 1e-10}; }

TEST(Seam, SameCylinderContinuedHasNoDefect) {
  const SeamReport r = check_seam(on_cylinder(continued_cylinder()));
  EXPECT_EQ(r.samples, 2048u);
  EXPECT_LE(r.gap.worst, rounding);
  EXPECT_LE(r.surface_gap.worst, rounding);
  EXPECT_LE(r.angle.worst, rounding);
  EXPECT_LE(r.curvature.worst, rounding);
  EXPECT_NEAR(r.transverse.worst, 1.0, rounding);
  EXPECT_NEAR(r.fold.worst, -1.0, rounding);
  EXPECT_EQ(r.folded, 0u);
  EXPECT_EQ(reached(r, tight()), Continuity::G2);
}

TEST(Seam, ArcOnACylinderJumpsByOneOverItsRadius) {
  for (const double rho : {0.1, 0.5, 2.0}) {
    const SeamReport r = check_seam(on_cylinder(flare(rho)));
    EXPECT_NEAR(r.curvature.worst, 1.0 / rho, rounding / rho);
    EXPECT_NEAR(r.curvature.rms, 1.0 / rho, 2048 * eps / rho);
    EXPECT_LE(r.angle.worst, rounding);
    EXPECT_EQ(reached(r, tight()), Continuity::G1);
  }
}

TEST(Seam, QuinticOnAPlaneIsG2AndAParabolaIsNot) {
  const auto quintic = [](const auto& u) { return u * u * u * (1.0 + u * (0.5 + u)); };
  EXPECT_EQ(reached(check_seam(on_plane(ramp(quintic))), tight()), Continuity::G2);
  const SeamReport r = check_seam(on_plane(ramp([](const auto& u) { return 0.35 * u * u; })));
  EXPECT_NEAR(r.curvature.worst, 0.7, rounding);
  EXPECT_EQ(reached(r, tight()), Continuity::G1);
}

TEST(Seam, ShiftIsReportedAsItsLength) {
  const auto radius = [](double s) {
    return revolution(
        turn, [s](const auto&) { return 1.0 + s; }, [](const auto& u) { return 1.0 + u; });
  };
  const SeamReport r = check_seam(on_cylinder(radius(1e-4)));
  EXPECT_NEAR(r.gap.worst, 1e-4, rounding);
  EXPECT_NEAR(r.surface_gap.worst, 1e-4, rounding);
  EXPECT_NEAR(r.gap.rms, 1e-4, 2048 * eps);
  EXPECT_EQ(reached(r, Tolerance{}), Continuity::none);
}

TEST(Seam, ShiftWithinThePrimaryLeavesTheSurfaceGapZero) {
  for (const double shift : {1e-7, 1e-4, 0.1}) {  // the first two use the second-order distance
    const auto lifted = revolution(
        turn, [](const auto&) { return 1.0; }, [shift](const auto& u) { return 1.0 - shift + u; });
    const SeamReport along = check_seam(on_cylinder(lifted));
    EXPECT_NEAR(along.gap.worst, shift, rounding);
    EXPECT_LE(along.surface_gap.worst, rounding);
    // Around the cylinder the tangent plane leaves the surface by shift^2 / 2; the next term is shift^4 / 24
    // at most where the formula is used, and the search beyond is exact.
    const Surface turned = surface(turn, [shift](const auto& u, const auto& v) {
      using T = std::remove_cvref_t<decltype(u)>;
      return std::array<T, 3>{cos(v + shift), sin(v + shift), 1.0 + u};
    });
    const SeamReport around = check_seam(on_cylinder(turned));
    EXPECT_NEAR(around.gap.worst, 2.0 * std::sin(0.5 * shift), rounding);
    EXPECT_LE(around.surface_gap.worst, rounding);
  }
}

TEST(Seam, TiltIsReportedAsItsAngle) {
  const double tilt = degrees(0.1).value;
  const auto cone = revolution(
      turn, [tilt](const auto& u) { return 1.0 + std::tan(tilt) * u; },
      [](const auto& u) { return 1.0 + u; });
  const SeamReport r = check_seam(on_cylinder(cone));
  EXPECT_NEAR(r.angle.worst, tilt, rounding);
  EXPECT_EQ(reached(r, Tolerance{}), Continuity::G0);
}

TEST(Seam, AngleIsSeenFarBelowTheResolutionOfTheArcCosine) {
  const auto cone = revolution(
      turn, [](const auto& u) { return 1.0 + 1e-12 * u; }, [](const auto& u) { return 1.0 + u; });
  EXPECT_NEAR(check_seam(on_cylinder(cone)).angle.worst, 1e-12, rounding);
}

TEST(Seam, HalvingADefectHalvesTheReport) {
  // Relative deviation from 2: tan(t)/t - 1 = t^2/3 for the tilt, rounding / defect otherwise; both below
  // 1e-6.
  for (double size = 1e-2; size > 1e-4; size *= 0.5) {
    const auto measured = [](double d) {
      const auto shape = [d](const auto& u) { return 1.0 + d + d * u + d * u * u; };
      return check_seam(on_cylinder(revolution(turn, shape, [](const auto& u) { return 1.0 + u; })));
    };
    const SeamReport whole = measured(size), half = measured(0.5 * size);
    EXPECT_NEAR(whole.gap.worst / half.gap.worst, 2.0, 1e-9);
    EXPECT_NEAR(whole.angle.worst / half.angle.worst, 2.0, size * size);
    // Curvature of the meridian 2d / (1 + d^2)^1.5, to first order in d.
    EXPECT_NEAR(whole.curvature.worst / half.curvature.worst, 2.0, 4.0 * size * size);
  }
}

TEST(Seam, BlendThatTurnsBackOverTheKeptPartFolds) {
  const auto back = revolution(
      turn, [](const auto&) { return 1.0; }, [](const auto& u) { return 1.0 - u; });
  Seam seam = on_cylinder(back);
  const SeamReport r = check_seam(seam);
  EXPECT_EQ(r.folded, r.samples);
  EXPECT_NEAR(r.fold.worst, 1.0, rounding);
  EXPECT_LE(r.angle.worst, rounding);
  EXPECT_EQ(reached(r, tight()), Continuity::G0);
  seam.kept_left = false;  // when the upper part is kept, the same blend is sound
  EXPECT_EQ(reached(check_seam(seam), tight()), Continuity::G2);
}

TEST(Seam, ObliqueBlendReportsItsSine) {
  const Surface oblique = surface({{0.0, 1.0}, {-1.0, 1.0}, false, false}, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{u, v + 20.0 * u, u * u * u};
  });
  const SeamReport r = check_seam(on_plane(oblique));
  EXPECT_NEAR(r.transverse.worst, 1.0 / std::sqrt(401.0), rounding);
  // The jump is measured across the trimline, so the blend's oblique lines do not change it.
  EXPECT_LE(r.curvature.worst, rounding * 400.0);
}

TEST(Seam, CrossedCylindersThatTouchAreNotG2) {
  // Radius 1 about z (the primary) and about y (the blend): at (1, 0, 0) they share the point, the tangent
  // plane, both principal curvatures, mean and Gaussian curvature; but across the trimline one is straight
  // and the other round.
  const Interval v{0.0, 1e-4};
  const Surface blend = surface({{0.0, 1.0}, v, false, false}, [](const auto& u, const auto& w) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{cos(w), u, sin(w)};
  });
  const Curve2 line = parameter_curve({v, false}, [](const auto& w) {
    using T = std::remove_cvref_t<decltype(w)>;
    return std::array<T, 2>{sin(w), T(0.0)};
  });
  const Seam seam{"trap", blend, 0, unit_cylinder(), line, false};
  const SeamReport r = check_seam(seam);
  EXPECT_LE(r.gap_at.front(), rounding);
  EXPECT_LE(r.angle_at.front(), rounding);
  EXPECT_NEAR(r.curvature_at.front(), 1.0, rounding);
  // Over the short trimline the tangent planes turn apart by 1e-4 rad and the gap is 5e-9: G1 within this
  // tolerance.
  const Tolerance wide{1e-6, Radians(2e-4), 1e-2};
  EXPECT_EQ(reached(r, wide), Continuity::G1);
}

TEST(Seam, OppositeNormalsOfTheSameCylinderAreStillG2) {
  const auto downwards = revolution(
      turn, [](const auto&) { return 1.0; }, [](const auto& u) { return -u; });
  Seam seam{"flipped", continued_cylinder(), 0, downwards, isoline_u(-1.0, turn_line), false};
  const SeamReport r = check_seam(seam);
  EXPECT_LE(r.curvature.worst, rounding);
  EXPECT_EQ(reached(r, tight()), Continuity::G2);
}

TEST(Seam, ClosestPointsServeWhereThereIsNoTrimline) {
  Seam seam = on_cylinder(flare(0.5));
  seam.pcurve.reset();
  const SeamReport r = check_seam(seam);
  EXPECT_LE(r.gap.worst, rounding);
  EXPECT_NEAR(r.curvature.worst, 2.0, rounding);
  EXPECT_EQ(reached(r, tight()), Continuity::G1);
  // A gap of 1e-4 off the surface, seen by searching.
  const auto wide = revolution(
      turn, [](const auto&) { return 1.0 + 1e-4; }, [](const auto& u) { return 1.0 - u; });
  seam.blend = wide;
  seam.kept_left = false;
  EXPECT_NEAR(check_seam(seam).gap.worst, 1e-4, rounding);
}

TEST(Seam, SamplesIncludeTheEndsAndAvoidUniformKnots) {
  const SeamReport r = check_seam(on_cylinder(continued_cylinder()));
  EXPECT_EQ(r.v.front(), 0.0);
  EXPECT_EQ(r.v.back(), 2.0 * pi);
  for (std::size_t i = 1; i < r.v.size(); ++i) EXPECT_LT(r.v[i - 1], r.v[i]);
  // frac(2046 k / m) is a fraction p / m' with m' <= m, and |golden - p / m'| > 1 / (3 m'^2).
  for (const int spans : {2, 3, 8, 64, 100, 512})
    for (std::size_t i = 1; i + 1 < r.v.size(); ++i) {
      const double knot = r.v[i] / (2.0 * pi) * spans;
      EXPECT_GT(std::abs(knot - std::round(knot)), spans / (3.0 * spans * spans * 2046.0) * 0.99);
    }
}

TEST(Seam, NotANumberIsTheWorstValueAndFails) {
  const Surface broken = surface(turn, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    const T r = 1.0 + 0.0 * sqrt(4.0 - v);  // a number up to v = 4
    return std::array<T, 3>{r * cos(v), r * sin(v), 1.0 + u};
  });
  const SeamReport r = check_seam(on_cylinder(broken));
  EXPECT_TRUE(std::isnan(r.gap.worst));
  EXPECT_TRUE(std::isnan(r.gap.rms));
  EXPECT_TRUE(std::isnan(r.angle.worst));
  EXPECT_TRUE(std::isnan(r.curvature.worst));
  EXPECT_NEAR(r.gap.v, 4.0, 2.0 * pi / 2046.0);
  EXPECT_EQ(reached(r, Tolerance{}), Continuity::none);
  Seam searched = on_cylinder(broken);
  searched.pcurve.reset();
  EXPECT_TRUE(std::isnan(check_seam(searched).gap.worst));
}

TEST(Seam, BlendWithoutCrossDerivativeHasNoAngle) {
  // Su = 0 all along the edge: the tangent plane is undefined there, and no limit along the edge helps.
  const auto still = revolution(
      turn, [](const auto&) { return 1.0; }, [](const auto& u) { return 1.0 + u * u; });
  const SeamReport r = check_seam(on_cylinder(still));
  EXPECT_LE(r.gap.worst, rounding);
  EXPECT_TRUE(std::isnan(r.angle.worst));
  EXPECT_EQ(reached(r, Tolerance{}), Continuity::G0);
}

TEST(Seam, CuspOfTheTrimlineIsMeasuredAsALimit) {
  // The irregular cone x = s cos v, y = s v sin v: its directrix has a zero derivative at v = 0.
  const auto cone = [](double slope) {
    return surface({{0.3, 1.0}, {0.0, 2.0 * pi}, false, false}, [slope](const auto& s, const auto& v) {
      using T = std::remove_cvref_t<decltype(s)>;
      return std::array<T, 3>{s * cos(v), s * v * sin(v), slope * (s - 0.3) + 0.6};
    });
  };
  const Seam seam{"cusp", cone(2.0), 0, cone(2.0), isoline_u(0.3, {{0.0, 2.0 * pi}, false}), true};
  const SeamReport sound = check_seam(seam);
  // Sv is some 1e-6 beside the cusp and rounded at 1e-16: normals are good to 1e-10 there.
  EXPECT_LE(sound.angle.worst, 1e-9);
  const Seam bent{"cusp", cone(2.1), 0, cone(2.0), isoline_u(0.3, {{0.0, 2.0 * pi}, false}), true};
  EXPECT_GT(check_seam(bent).angle.worst, 0.01);
}

TEST(Seam, WithoutPrimaryNothingIsMeasured) {
  Seam seam = on_cylinder(continued_cylinder());
  seam.primary.reset();
  const SeamReport r = check_seam(seam);
  EXPECT_FALSE(r.measured);
  EXPECT_EQ(r.samples, 0u);
  EXPECT_EQ(reached(r, Tolerance{}), Continuity::none);
}

TEST(Seam, StopRequestEndsTheCheck) {
  std::stop_source source;
  source.request_stop();
  Progress progress;
  progress.stop = source.get_token();
  EXPECT_THROW((void)check_seam(on_cylinder(continued_cylinder()), {}, progress), Cancelled);
}

}  // namespace
}  // namespace blendwright
