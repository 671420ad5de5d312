// What the formulas of potentials and range maps promise.
#include "implicit/operators/potential.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "implicit/operators/range_map.hpp"
#include "tests/implicit/operators/op_tape.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double eps = std::numeric_limits<double>::epsilon();

double at(const Tape& tape, double d, double other = 0.0) { return sample(tape, {d, other, 0.0}).value; }

struct Named {
  const char* name;
  std::shared_ptr<const Tape> tape;
  double end;  ///< P(1)
};
std::vector<Named> potentials(double softness) {
  return {{"blanc", op_tape(detail::Blanc{softness}, 1), 0.0},
          {"wyvill", op_tape(detail::Wyvill{}, 1), 0.0},
          {"gaussian", op_tape(detail::Gaussian{}, 1), 0.0625},
          {"gaussian_windowed", op_tape(detail::GaussianWindowed{}, 1), 0.0}};
}

TEST(Potential, IsOneInTheMiddleAndOneHalfAtTheSurface) {
  for (const double s : {0.0, 1e-300, 0.25, 1.0, 2.5, 1e3, 1e6})
    for (const Named& p : potentials(s)) {
      EXPECT_EQ(at(*p.tape, 0.0), 1.0) << p.name;
      EXPECT_NEAR(at(*p.tape, 0.5), 0.5, 4 * eps) << p.name;  // exp and one product
      EXPECT_NEAR(at(*p.tape, 1.0), p.end, 4 * eps) << p.name;
    }
}

TEST(Potential, IsExactlyNothingBeyondItsSupport) {
  for (const Named& p : potentials(0.5))
    for (const double d : {p.end > 0.0 ? 15.0 : 1.0, 16.0, 1e200, infinity}) {
      const Sampled f = sample(*p.tape, {d, 0.0, 0.0});
      EXPECT_EQ(f.value, 0.0) << p.name;
      EXPECT_EQ(f.gradient, Vec3(0, 0, 0)) << p.name;
    }
}

TEST(Potential, HasNoSlopeInTheMiddleAndAtTheEdge) {
  for (const double s : {0.0, 1e-12, 0.25, 2.5, 1e6})
    for (const Named& p : potentials(s)) {
      EXPECT_EQ(sample(*p.tape, Vec3::Zero()).gradient.x(), 0.0) << p.name;
      if (p.end > 0.0) continue;
      // P'' <= 32/9 below the edge for blanc, 32/9 and 8 for the others: P' there is at most that times the
      // gap.
      EXPECT_NEAR(sample(*p.tape, {1.0 - 1e-9, 0, 0}).gradient.x(), 0.0, 1e-8) << p.name;
    }
}

TEST(Potential, Falls) {
  for_all(
      [](Rng& rng) {
        const double s = integer(rng, 0, 4) == 0 ? 0.0 : log_uniform(rng, 1e-6, 1e6);
        for (const Named& p : potentials(s)) {
          const double a = uniform(rng, 0.0, 1.2), b = a + log_uniform(rng, 1e-12, 0.3);
          // Where it is flat or steep neighbours may differ by their rounding: a few eps of P, and of d times
          // P'.
          const double slack = 8.0 * eps * (1.0 + b * std::abs(sample(*p.tape, {a, 0, 0}).gradient.x()));
          EXPECT_GE(at(*p.tape, a), at(*p.tape, b) - slack)
              << p.name << " s " << s << " at " << a << ", " << b;
          EXPECT_GE(at(*p.tape, b), 0.0);
          EXPECT_LE(at(*p.tape, a), 1.0);
        }
      },
      2000);
}

TEST(Potential, OfBlancIsAsSteepAsItSaysAtTheSurface) {
  for (const double s : {0.0, 0.25, 1.0, 20.0}) {
    const auto tape = op_tape(detail::Blanc{s}, 1);
    const double slope = -(2.0 + 16.0 * s / 9.0);
    for (const double d : {0.5, std::nextafter(0.5, 1.0)})  // both branches: C1
      EXPECT_NEAR(sample(*tape, {d, 0, 0}).gradient.x(), slope, 1e-12 * std::abs(slope));
  }
}

TEST(Potential, HasARangeOfExactlyNothingBeyondItsSupport) {
  for (const Named& p : potentials(1.0)) {
    const Range r = p.tape->range({Vec3(15.0, 0, 0), Vec3(20.0, 1, 1)});
    EXPECT_EQ(r, (Range{0.0, 0.0})) << p.name;
    const Range whole = p.tape->range({Vec3(0, 0, 0), Vec3(20.0, 1, 1)});
    EXPECT_EQ(whole, (Range{0.0, 1.0})) << p.name;
  }
}

// ---- Range maps
// --------------------------------------------------------------------------------------------

TEST(RangeMap, OfOneAndOneIsTheDistanceItself) {
  const auto tape = op_tape(detail::RangeMap{1.0, 1.0}, 1);
  for (const double d : {0.0, 0.1, 0.4, 0.5, 0.7, 0.99}) EXPECT_NEAR(at(*tape, d), d, 2 * eps);
  EXPECT_EQ(at(*tape, 1.0), 1.0);
  EXPECT_EQ(at(*tape, infinity), 1.0);
}

TEST(RangeMap, MeetsItsThreePointsAndRises) {
  for_all([](Rng& rng) {
    const double w1 = log_uniform(rng, 0.02, 5.0), w2 = std::min(1.0, w1 * uniform(rng, 0.02, 2.0));
    const auto tape = op_tape(detail::RangeMap{w1, w2}, 1);
    EXPECT_EQ(at(*tape, 0.5 * (1.0 - w2)), 0.0);
    EXPECT_NEAR(at(*tape, 0.5), 0.5, 4 * eps);
    EXPECT_EQ(at(*tape, 0.5 * (1.0 + w1)), 1.0);
    const double a = uniform(rng, 0.0, 3.0), b = a + log_uniform(rng, 1e-10, 1.0);
    EXPECT_LE(at(*tape, a), at(*tape, b) + 4 * eps);
    // Smooth across the surface: both one-sided slopes are 1/w1.
    for (const double d : {std::nextafter(0.5, 0.0), 0.5})
      EXPECT_NEAR(sample(*tape, {d, 0, 0}).gradient.x(), 1.0 / w1, 1e-12 / w2 + 1e-12 / w1);
  });
}

TEST(RangeMap, HasExactPiecesOnBoxes) {
  const auto tape = op_tape(detail::RangeMap{0.5, 0.5}, 1);
  const auto range = [&](double lo, double hi) { return tape->range({Vec3(lo, 0, 0), Vec3(hi, 1, 1)}); };
  EXPECT_EQ(range(0.75, 3.0), (Range{1.0, 1.0}));
  EXPECT_EQ(range(0.0, 0.25), (Range{0.0, 0.0}));
  EXPECT_EQ(range(0.0, 3.0), (Range{0.0, 1.0}));
}

TEST(VirMap, EndsAtTheContour) {
  for_all([](Rng& rng) {
    const detail::VirMap body{uniform(rng, 0.1, 1.0), 0.02, false};
    const auto tape = op_tape(body, 2);
    const double d = uniform(rng, 0.55, 3.0);
    // d is at the contour where f_c = 1; w1 = 2 d - 1 >= 2 w_floor, so the guard sleeps: T = 1 within
    // rounding
    EXPECT_NEAR(at(*tape, d, 1.0), 1.0, 8 * eps / (2.0 * d - 1.0));
    EXPECT_EQ(at(*tape, d, 1.0 + 1e-9), 1.0);
    EXPECT_LT(at(*tape, d, 1.0 - 1e-6), 1.0);
    EXPECT_EQ(at(*tape, 0.5, uniform(rng, 0.1, 5.0)), 0.5);
  });
}

TEST(VirMap, NeverMakesMaterialOutsideWhereTheContourLiesInside) {
  for_all([](Rng& rng) {
    const double floor = log_uniform(rng, 1e-3, 0.3);
    const auto tape = op_tape(detail::VirMap{0.5, floor, false}, 2);
    const double d = uniform(rng, 0.5, 2.0), contour = 2.0 * d * uniform(rng, 1.0, 10.0);  // f_c >= 2 d
    EXPECT_GE(at(*tape, d, contour), 0.5);
    // the floor itself: T = 1/2 + (d - 1/2)/w0
    EXPECT_NEAR(at(*tape, d, contour), std::min(1.0, 0.5 + (d - 0.5) / floor), 8 * eps * (1.0 + 1.0 / floor));
  });
}

TEST(VirMap, IsOneHalfAlongARayWithoutContour) {
  const auto tape = op_tape(detail::VirMap{1.0, 0.02, false}, 2);
  EXPECT_EQ(at(*tape, 2.0, 0.0), 0.5);
  EXPECT_EQ(at(*tape, 0.0, 0.0), 0.0);
}

TEST(VirMap, IsSmoothAcrossTheSurfaceWhenCoupled) {
  for_all([](Rng& rng) {
    const double floor = log_uniform(rng, 0.05, 0.3),
                 w2 = uniform(rng, 0.2, 1.0) * std::min(1.0, 2.0 * floor);
    const auto tape = op_tape(detail::VirMap{w2, floor, true}, 2);
    const double contour = uniform(rng, 0.2, 2.0);
    const Vec3 below = sample(*tape, {std::nextafter(0.5, 0.0), contour, 0}).gradient;
    const Vec3 above = sample(*tape, {0.5, contour, 0}).gradient;
    EXPECT_LT((below - above).norm(), 1e-11 * above.norm() / w2);
  });
}

TEST(VirMap, HasARangeOfExactlyOneBeyondTheContour) {
  const auto tape = op_tape(detail::VirMap{1.0, 0.02, false}, 2);
  EXPECT_EQ(tape->range({Vec3(0.6, 1.01, 0), Vec3(0.8, 1.1, 1)}), (Range{1.0, 1.0}));
  EXPECT_LT(tape->range({Vec3(0.6, 0.9, 0), Vec3(0.8, 1.1, 1)}).lo, 1.0);
}

}  // namespace
}  // namespace blendwright::test
