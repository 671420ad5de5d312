#include "verify/surface/surface_checks.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "kernel/base/parallel_for.hpp"
#include "tests/verify/shapes.hpp"

namespace blendwright {
namespace {

using namespace test;

constexpr double eps = std::numeric_limits<double>::epsilon();
const SurfaceDomain square{{0.0, 1.0}, {0.0, 1.0}, false, false};

// A number up to v = 4.
Surface partly_undefined() {
  return surface(turn, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    const T r = 1.0 + 0.0 * sqrt(4.0 - v);
    return std::array<T, 3>{r * cos(v), r * sin(v), 1.0 + u};
  });
}

TEST(Fold, SoundBlendsHaveNone) {
  const FoldReport r = check_fold(flare(0.5));
  EXPECT_EQ(r.folded, 0u);
  EXPECT_GT(r.smallest_area.value, 0.5);
  // A quarter turn over 24 steps of at most 1.25 of the mean: 4.69 deg; a whole one over 128 is less.
  EXPECT_LT(r.where.value, degrees(4.69).value);
}

TEST(Fold, StripThatTurnsBackIsFoundAllAlong) {
  // x = u - 1.5 u^2 turns back at u = 1/3, all along v.
  const Surface strip = surface(square, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{u - 1.5 * u * u, v, T(0.0)};
  });
  const FoldReport r = check_fold(strip, 32, 16);
  EXPECT_EQ(r.folded, 17u);
  EXPECT_NEAR(r.where.value, pi, 4 * eps);
  EXPECT_NEAR(r.where.at.u, 1.0 / 3.0, 1.25 / 32.0);
}

TEST(Fold, TightSmoothBendIsNotAFold) {
  // The normal turns by atan(1600 t) about t = 0: over 170 deg within one cell of 1/16, but not at once.
  const Surface hairpin = surface({{-1.0, 1.0}, {0.0, 1.0}, false, false}, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{-40.0 * u * u, v, 0.05 * u};
  });
  const FoldReport r = check_fold(hairpin);
  EXPECT_GT(r.where.value, 0.5 * pi);  // the samples alone would say "fold"
  EXPECT_EQ(r.folded, 0u);
}

TEST(Fold, SurfaceWithoutCrossDerivativeHasNoArea) {
  const Surface thread = surface(square, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{T(v), v * v, T(0.0)};
  });
  EXPECT_EQ(check_fold(thread).smallest_area.value, 0.0);
  EXPECT_TRUE(std::isnan(minimum_radius(thread).value));
}

TEST(Fold, PinchedPlaceIsFound) {
  // Su and Sv become parallel along v = 1/2 only in the limit: |Su x Sv| = (v - 1/2)^2 + 1e-12.
  const Surface pinched = surface(square, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    const T d = v - 0.5;
    return std::array<T, 3>{u, v * 0.0, d * d * d / 3.0 + 1e-12 * v};
  });
  const FoldReport r = check_fold(pinched);
  EXPECT_NEAR(r.smallest_area.at.v, 0.5, 1.0 / 128.0);
  // The nearest sample is within half a step of 1.25/128 of the place; the mean of (v - 1/2)^2 is 1/12.
  EXPECT_LT(r.smallest_area.value, 12.0 * std::pow(0.5 * 1.25 / 128.0, 2) * 1.1);
}

TEST(Fold, NotANumberStays) { EXPECT_TRUE(std::isnan(check_fold(partly_undefined()).smallest_area.value)); }

TEST(MinimumRadius, IsTheFlareRadius) {
  for (const double rho : {0.05, 0.4}) EXPECT_NEAR(minimum_radius(flare(rho)).value, rho, 1e-13);
}

TEST(MinimumRadius, IsInfiniteOnAPlane) { EXPECT_TRUE(std::isinf(minimum_radius(plane_patch()).value)); }

TEST(MinimumRadius, IsRefinedBetweenSamples) {
  for_all(
      [](Rng& rng) {
        // The ellipse with half axes a > b bends most at its long ends, radius b^2/a.
        const double a = uniform(rng, 1.5, 3.0), shift = uniform(rng, -0.5, 0.5);
        const Surface tube =
            surface({{-1.0, 1.0}, {0.0, 1.0}, false, false}, [a, shift](const auto& u, const auto& v) {
              using T = std::remove_cvref_t<decltype(u)>;
              return std::array<T, 3>{a * cos(u - shift), sin(u - shift), v};
            });
        const Extreme r = minimum_radius(tube);
        // The search ends with steps of 2^-12 of half a cell, 8e-6; the radius (a^2 s^2 + c^2)^1.5 / a grows
        // from its minimum like 1.5 (a^2 - 1) / a du^2. A compass on a smooth top stops within two of its
        // last steps.
        const double du = 2.0 * 8e-6;
        EXPECT_NEAR(r.at.u, shift, du);
        EXPECT_NEAR(r.value, 1.0 / a, 1.5 * a * du * du);
      },
      50);
}

TEST(MinimumRadius, NotANumberStays) { EXPECT_TRUE(std::isnan(minimum_radius(partly_undefined()).value)); }

// Height over the plane z = 0; ends on it, tangent, at u = 1.
template <class F>
Surface landing(F f) {
  return ramp([f](const auto& u) { return (1.0 - u) * (1.0 - u) * f(u); });
}
// (1-u)^2 (1-4u) has its minimum -1/4 at u = 1/2.
Surface diving() {
  return landing([](const auto& u) { return 1.0 - 4.0 * u; });
}

TEST(Penetration, OfKnownDepthIsMeasuredThere) {
  const PenetrationReport r = check_penetration(diving(), 1, plane_patch());
  EXPECT_TRUE(r.judged);
  // The search ends with steps of 2^-12 of half a cell of 1/16: 8e-6, and f'' = 6.
  EXPECT_NEAR(r.depth.value, 0.25, 3.0 * 1.6e-5 * 1.6e-5);
  EXPECT_NEAR(r.depth.at.u, 0.5, 1.6e-5);
  EXPECT_NEAR(r.depth.point.z(), -r.depth.value, 1e-15);
}

TEST(Penetration, SoundLandingHasNone) {
  const auto r = check_penetration(landing([](const auto& u) { return 1.0 + u; }), 1, plane_patch());
  EXPECT_TRUE(r.judged);
  EXPECT_EQ(r.depth.value, 0.0);
}

TEST(Penetration, DoesNotDependOnThePrimarysNormal) {
  const Surface flipped = surface({{-2.0, 2.0}, {-2.0, 2.0}, false, false}, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{v, u, T(0.0)};
  });
  EXPECT_NEAR(check_penetration(diving(), 1, flipped).depth.value, 0.25, 1e-8);
}

TEST(Penetration, OnlyFeetInsideThePrimaryCount) {
  const Surface short_plane =
      surface({{0.7, 2.0}, {-2.0, 2.0}, false, false}, [](const auto& u, const auto& v) {
        using T = std::remove_cvref_t<decltype(u)>;
        return std::array<T, 3>{u, v, T(0.0)};
      });
  const PenetrationReport r = check_penetration(diving(), 1, short_plane);
  // Nothing lies above this plane: the side of the far end is that of the first row over it, which is below.
  EXPECT_TRUE(r.judged);
  EXPECT_EQ(r.depth.value, 0.0);
}

TEST(Penetration, FarEndOnBothSidesIsNotJudged) {
  const Surface tilted = surface({{0.0, 1.0}, {-1.0, 1.0}, false, false}, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{u, v, (1.0 - u) * (1.0 - u) * v};
  });
  EXPECT_FALSE(check_penetration(tilted, 1, plane_patch()).judged);
}

TEST(Penetration, NotANumberStays) {
  EXPECT_TRUE(std::isnan(check_penetration(partly_undefined(), 0, unit_cylinder()).depth.value));
}

// The paper's joint of a vertical cylinder (radius 1/2, from z = 2) with the horizontal cylinder x^2 + z^2
// = 1.44, with the sweep equation's repeated root q: cardinal functions a(u) = sinh qu + q w cosh qu, w = 1 -
// u, S = sinh q, H1 = [S a(u) - q a(w)]/(S^2 - q^2), K1 = [q u sinh qw - w S sinh qu]/(S^2 - q^2), H0(u) =
// H1(w), K0(u) = -K1(w).
Surface eq14(double q, bool chord) {
  return surface(turn, [q, chord](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    const double S = std::sinh(q), D = S * S - q * q;
    const T w = 1.0 - u;
    const auto a = [&](const T& x, const T& y) { return sinh(q * x) + q * y * cosh(q * x); };
    const auto H = [&](const T& x, const T& y) { return (S * a(x, y) - q * a(y, x)) / D; };
    const auto K = [&](const T& x, const T& y) { return (q * x * sinh(q * y) - S * y * sinh(q * x)) / D; };
    const double rho = 0.75, r = 1.2;
    const T z1 = sqrt(r * r - rho * rho * cos(v) * cos(v));
    const std::array<T, 3> C0{0.5 * cos(v), 0.5 * sin(v), T(2.0)}, C1{rho * cos(v), rho * sin(v), z1};
    const std::array<T, 3> T0{T(0.0), T(0.0), T(-1.2)};
    const std::array<T, 3> T1{0.8 * cos(v), 0.8 * sin(v), -0.8 * rho * cos(v) * cos(v) / z1};
    std::array<T, 3> point;
    for (std::size_t k = 0; k < 3; ++k) {
      const T De = C1[k] - C0[k];
      point[k] = chord ? C0[k] + u * De + (T0[k] - De) * (-K(w, u)) + (T1[k] - De) * K(u, w)
                       : C0[k] * H(w, u) + C1[k] * H(u, w) + T0[k] * (-K(w, u)) + T1[k] * K(u, w);
    }
    return point;
  });
}
Surface horizontal_cylinder() {
  return surface({{-2.0, 2.0}, {0.0, 2.0 * pi}, false, true}, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{1.2 * cos(v), T(u), 1.2 * sin(v)};
  });
}

TEST(Penetration, OriginPullDrivesThePapersJointThroughThePrimary) {
  // c = -30: q^2 = 15. A fine scan finds min x^2 + z^2 - 1.44 = -0.344, a depth of 1.2 - sqrt(1.096) =
  // 0.1531; half a unit of the last digit of -0.344 is 2.4e-4 of depth.
  const PenetrationReport deep = check_penetration(eq14(std::sqrt(15.0), false), 1, horizontal_cylinder());
  EXPECT_TRUE(deep.judged);
  EXPECT_NEAR(deep.depth.value, 0.1531, 3e-4);
  // c = -15: -0.006, a depth of 0.0025; half a unit of its last digit is 2.1e-4.
  const PenetrationReport shallow = check_penetration(eq14(std::sqrt(7.5), false), 1, horizontal_cylinder());
  EXPECT_NEAR(shallow.depth.value, 0.0025, 3e-4);
}

TEST(Penetration, ChordModeOfThePapersJointStaysOutside) {
  for (const double c : {3.0, 5.0, 15.0, 30.0}) {
    const PenetrationReport r = check_penetration(eq14(std::sqrt(0.5 * c), true), 1, horizontal_cylinder());
    EXPECT_TRUE(r.judged);
    EXPECT_LE(r.depth.value, 1e-14) << "c = -" << c;  // the trimline itself is on the surface up to rounding
  }
}

TEST(Closing, ClosedSurfaceCloses) {
  const ClosingReport r = check_closing(flare(0.5));
  EXPECT_LE(r.gap, 50 * eps);
  // First derivatives are continued from 2 pi 1e-8 away: error h^2/2 = 2e-15; second derivatives are off by
  // h.
  EXPECT_LE(r.angle.value, 1e-14);
  EXPECT_LE(r.curvature, 4.0 * 2.0 * pi * 1e-8);
}

// Tube about z with radius r(v) over one turn.
template <class R>
Surface tube(R r) {
  return surface({{0.0, 1.0}, {0.0, 2.0 * pi}, false, false}, [r](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::array<T, 3>{T(r(v)) * cos(v), T(r(v)) * sin(v), u};
  });
}

TEST(Closing, EachMismatchIsMeasured) {
  // A quintic step 10 s^3 - 15 s^4 + 6 s^5 is flat to second order at both ends: only the position differs.
  const auto step = [](const auto& v) {
    const auto s = v * (0.5 / pi);
    return 1.0 + 1e-4 * s * s * s * (10.0 - s * (15.0 - 6.0 * s));
  };
  EXPECT_NEAR(check_closing(tube(step)).gap, 1e-4, 50 * eps);
  // Polar slope r' = 0.02 at the end only: the tangent turns by atan(0.02).
  const auto slope = [](const auto& v) {
    const auto s = v * (0.5 / pi);
    return 1.0 + 0.02 * 2.0 * pi * s * s * s * s * (s - 1.0);
  };
  const ClosingReport kink = check_closing(tube(slope));
  EXPECT_LE(kink.gap, 50 * eps);
  EXPECT_NEAR(kink.angle.value, std::atan(0.02), 1e-13);
  // r = 1 + J/2 (v - 2 pi)^2 (v / 2 pi)^3: at v = 2 pi r' = 0 and r'' = J, so the polar curvature is 1 - J
  // there.
  const double J = 0.25;
  const auto bend = [J](const auto& v) {
    const auto s = v * (0.5 / pi), d = v - 2.0 * pi;
    return 1.0 + 0.5 * J * d * d * s * s * s;
  };
  const ClosingReport jump = check_closing(tube(bend));
  EXPECT_LE(jump.angle.value, 1e-13);
  // Second derivatives are taken h = 2 pi 1e-8 inside, and r''' = 9 J / (2 pi) there.
  EXPECT_NEAR(jump.curvature, J, 2.0 * pi * 1e-8 * 10.0);
}

TEST(Closing, WrappingParameterHidesNothing) {
  // Called closed, evaluated on the wrapped parameter, and yet 1e-4 apart: S(2 pi) itself would agree with
  // S(0).
  const Surface wrapping = surface(turn, [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    const T w = v - 2.0 * pi * std::floor(v.value() * (0.5 / pi));
    const T r = 1.0 + 1e-4 * (0.5 / pi) * w;
    return std::array<T, 3>{r * cos(w), r * sin(w), u};
  });
  EXPECT_NEAR(check_closing(wrapping).gap, 1e-4, 1e-12);
}

TEST(Closing, NotANumberStays) { EXPECT_TRUE(std::isnan(check_closing(partly_undefined()).gap)); }

TEST(SurfaceChecks, DoNotDependOnTheNumberOfThreads) {
  const auto all = [] {
    const PenetrationReport p = check_penetration(eq14(std::sqrt(15.0), false), 1, horizontal_cylinder());
    const Extreme r = minimum_radius(flare(0.3));
    return std::array<double, 5>{p.depth.value, p.depth.at.u, p.depth.at.v, r.value, r.at.u};
  };
  const auto many = all();
  const ThreadLimit one(1);
  EXPECT_EQ(many, all());
}

}  // namespace
}  // namespace blendwright
