#include "parametric/trimline/shifted.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/geometry/enclosure.hpp"
#include "tests/parametric/sample_lines.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using namespace test;
using ::testing::HasSubstr;

std::vector<ShiftPoint> random_shift(Rng& rng, double size, int least = 1) {
  std::vector<ShiftPoint> shift;
  const int count = integer(rng, least, 9);
  for (int i = 0; i < count; ++i)
    shift.push_back(
        {(i + uniform(rng, 0.0, 0.8)) / count, Vec2(uniform(rng, -size, size), uniform(rng, -size, size))});
  return shift;
}

Trimline ring() { return isoline(cylinder(2.0, -1.0, 1.0), IsoDirection::constant_u, 0.0); }
Trimline bar() { return isoline(plane(3.0), IsoDirection::constant_u, 0.5, Interval{-2.0, 1.5}); }

TEST(Shifted, RunsThroughItsPoints) {
  for_all([](Rng& rng) {
    const std::vector<ShiftPoint> shift = random_shift(rng, 0.05);
    for (const Trimline& line : {ring(), bar()}) {
      const Trimline moved = shifted(line, shift);
      ASSERT_EQ(moved.domain().closed, line.domain().closed);
      for (const ShiftPoint& p : shift) {
        const double v = line.domain().v.at(p.t);
        // Polynomials of degree 5 with coefficients that solve a banded system: some hundred roundings.
        EXPECT_LE((moved.pcurve().point(v) - line.pcurve().point(v) - p.by).norm(), 1e-13);
      }
    }
  });
}

TEST(Shifted, DerivativesAgreeWithCentralDifferences) {
  for_all(
      [](Rng& rng) {
        std::vector<ShiftPoint> shift;
        for (int i = 0; i < 6; ++i) shift.push_back({i / 6.0, Vec2(uniform(rng, -0.02, 0.02), 0.03 * i)});
        shift.back().by[1] = 0.0;
        for (const Trimline& line : {shifted(ring(), shift), shifted(bar(), shift)}) {
          const double v = line.domain().v.at(uniform(rng, 0.1, 0.9)), h = 1e-3;
          for (std::size_t k = 0; k < 3; ++k) {
            const auto D = [&](double x) { return line.pcurve().jet(x).D[k]; };
            const Vec2 expected = (D(v + h) - D(v - h)) / (2.0 * h);
            // Second order: h^2 / 6 of the derivative three orders up, where the spline has jumps of its
            // fifth; 0.03 (6 / 3.5)^5 5! / 2 = 27 on the shorter line, so 1e-6 * 27 at most, h * 27 across a
            // knot at k = 2.
            EXPECT_LE((line.pcurve().jet(v).D[k + 1] - expected).norm(), k < 2 ? 3e-5 : 3e-2) << k;
          }
        }
      },
      60);
}

TEST(Shifted, ClosedLinesStayClosedToTheThirdDerivative) {
  for_all([](Rng& rng) {
    const Trimline line = shifted(ring(), random_shift(rng, 0.05));
    const CurveJet<3> a = line.jet(0.0), b = line.jet(std::nextafter(2.0 * pi, 0.0));
    // The third derivative has slopes of up to 0.05 (9 / 2 pi)^4 4! for 9 close points, times 1e-15.
    for (std::size_t k = 0; k < 4; ++k) EXPECT_LE((a.D[k] - b.D[k]).norm(), 1e-9) << k;
  });
}

TEST(Shifted, TwoPointsOfAnOpenLineMakeAStraightLaw) {
  const Trimline line = shifted(bar(), {{0.0, Vec2(0.1, 0.0)}, {1.0, Vec2(0.5, -0.2)}});
  for (const double t : {0.1, 0.35, 0.8}) {
    const CurveJet<2> at = line.pcurve().jet(line.domain().v.at(t));
    EXPECT_NEAR(at.C()[0], 0.5 + 0.1 + 0.4 * t, 1e-15);
    EXPECT_EQ(at.C2(), Vec2(0.0, 0.0));
  }
}

TEST(Shifted, NoPointsAndZeroShiftsLeaveTheLineToTheLastBit) {
  const Trimline line = ring();
  for (const auto& shift : {std::vector<ShiftPoint>{}, std::vector<ShiftPoint>{{0.3, Vec2(0.0, 0.0)}},
                            std::vector<ShiftPoint>{{0.0, Vec2(0.0, 0.0)}, {0.5, Vec2(0.0, 0.0)}}})
    for (const double v : {0.0, 1.0, 4.0})
      for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(shifted(line, shift).jet(v).D[k], line.jet(v).D[k]);
}

TEST(Shifted, EnclosuresHoldTheCurveBetweenSamples) {
  int finite = 0, all = 0;
  for_all([&](Rng& rng) {
    for (const Trimline& plain : {ring(), bar()}) {
      const Trimline line = shifted(plain, random_shift(rng, 0.05, 2));
      const Interval range = line.domain().v;
      const double half = range.length() / 64.0, middle = range.at(uniform(rng, 0.05, 0.95));
      CurveEnclosure out;
      ASSERT_TRUE(line.pcurve().enclose(TaylorModel::parameter(middle - half, middle + half), out));
      ASSERT_TRUE(out.unproven.empty());
      for (int i = 0; i < 8; ++i) {
        const double x = uniform(rng, -1.0, 1.0);
        const CurveJet<2> at = line.pcurve().jet(middle + half * x);
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t d = 0; d < 2; ++d) {
            const Bounds b = out.D[k][d].at(x);
            const double value = at.D[k][static_cast<Eigen::Index>(d)];
            // The jet itself is rounded: some hundred roundings of its largest terms.
            const double rounding = 1e-12 * std::max(1.0, std::abs(value));
            EXPECT_TRUE(b.lo - rounding <= value && value <= b.hi + rounding) << k << " " << d;
            finite += b.finite();
            ++all;
          }
      }
    }
  });
  EXPECT_GT(finite, 9 * all / 10);
}

TEST(Shifted, BadPointsAreToldTogether) {
  try {
    (void)shifted(ring(), {{0.0, Vec2(0.0, 0.0)}, {0.0, Vec2(std::nan(""), 0.0)}, {1.0, Vec2(0.1, 0.0)}});
    FAIL();
  } catch (const InputError& e) {
    ASSERT_EQ(e.problems().size(), 3U);
    EXPECT_EQ(e.problems()[0].where, "shift/1");
    EXPECT_THAT(e.problems()[0].message, HasSubstr("must come after 0"));
    EXPECT_THAT(e.problems()[1].message, HasSubstr("finite"));
    EXPECT_THAT(e.problems()[2].message, HasSubstr("same point of a closed trimline"));
  }
  // On an open line its ends are two points.
  EXPECT_NO_THROW((void)shifted(bar(), {{0.0, Vec2(0.0, 0.0)}, {1.0, Vec2(0.1, 0.0)}}));
}

TEST(Shifted, LeavingThePrimaryIsAnErrorThatSaysWhere) {
  try {
    (void)shifted(ring(), {{0.0, Vec2(0.0, 0.0)}, {0.5, Vec2(1.25, 0.0)}});
    FAIL();
  } catch (const GeometryError& e) {
    EXPECT_THAT(e.what(), HasSubstr("leaves its primary"));
  }
}

}  // namespace
}  // namespace blendwright
