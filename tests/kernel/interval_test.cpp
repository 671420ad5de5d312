#include "kernel/math/interval.hpp"

#include <gtest/gtest.h>

#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::Rng;
using test::uniform;

/// Extended precision has 64 bits: its own error is far below the step outward.
bool contains(const Bounds& b, long double x) {
  return static_cast<long double>(b.lo) <= x && x <= static_cast<long double>(b.hi);
}
Bounds random_bounds(Rng& rng) {
  const double a = uniform(rng, -3.0, 3.0) * std::exp2(test::integer(rng, -20, 20));
  const double b = a + std::abs(a) * uniform(rng, 0.0, 1.0);
  return {std::min(a, b), std::max(a, b)};
}
double within(Rng& rng, const Bounds& b) {
  return std::min(std::max(b.lo + uniform(rng, 0.0, 1.0) * (b.hi - b.lo), b.lo), b.hi);
}

TEST(Bounds, ContainTheResultsOfTheirMembers) {
  for_all(
      [](Rng& rng) {
        const Bounds a = random_bounds(rng), b = random_bounds(rng);
        const double x = within(rng, a), y = within(rng, b);
        const auto lx = static_cast<long double>(x), ly = static_cast<long double>(y);
        EXPECT_TRUE(contains(a + b, lx + ly));
        EXPECT_TRUE(contains(a - b, lx - ly));
        EXPECT_TRUE(contains(a * b, lx * ly));
        EXPECT_TRUE(contains(square(a), lx * lx));
        EXPECT_TRUE(contains(hull(a, b), lx));
        if (b.mignitude() > 0.0) {
          EXPECT_TRUE(contains(a / b, lx / ly));
        }
        const double p = std::abs(x) + 1e-6;
        const Bounds positive(p, p * uniform(rng, 1.0, 2.0));
        const auto lp = static_cast<long double>(p);
        EXPECT_TRUE(contains(sqrt(positive), sqrtl(lp)));
        EXPECT_TRUE(contains(power(positive, -1.75), powl(lp, -1.75L)));
        EXPECT_TRUE(contains(log(positive), logl(lp)));
        const double e = uniform(rng, -5.0, 5.0);
        EXPECT_TRUE(contains(exp(Bounds(e)), expl(static_cast<long double>(e))));
      },
      2000);
}

TEST(Bounds, OfFractionsContainThemExactly) {
  // lo b and hi b have at most 53 + 11 bits: exact in extended precision. Both sides of a/b are compared
  // without any rounding. The control: the nearest double alone is on the wrong side in about half the cases.
  int nearest_fails = 0;
  for_all([&](Rng& rng) {
    const double a = test::integer(rng, -1000000, 1000000), b = test::integer(rng, 1, 2000);
    const Bounds q = Bounds(a) / Bounds(b);
    const auto side = [&](double x) { return static_cast<long double>(x) * static_cast<long double>(b); };
    EXPECT_LE(side(q.lo), static_cast<long double>(a));
    EXPECT_GE(side(q.hi), static_cast<long double>(a));
    EXPECT_LE(q.hi - q.lo, 8.0 * 0x1p-52 * std::abs(a / b) + 1e-300);
    nearest_fails += side(a / b) > static_cast<long double>(a) ? 1 : 0;
  });
  EXPECT_GT(nearest_fails, 20);
}

TEST(Bounds, AreInfiniteWhereAFunctionIsNotDefined) {
  EXPECT_FALSE((Bounds(1.0) / Bounds(-1.0, 1.0)).finite());
  EXPECT_FALSE(log(Bounds(0.0, 1.0)).finite());
  EXPECT_FALSE(sqrt(Bounds(-2.0, -1.0)).finite());
  EXPECT_FALSE((unbounded() * Bounds(0.0)).finite());
  EXPECT_TRUE((Bounds(1.0) / Bounds(0.5, 1.0)).finite());
}

TEST(Bounds, OfAnAngleAreThoseOfItsCorners) {
  const Bounds angle = first_quadrant_angle({0.0, 1.0}, {0.0, 1.0});
  EXPECT_LE(angle.lo, 0.0);
  EXPECT_GE(angle.hi, std::atan2(1.0, 0.0));
  const Bounds narrow = first_quadrant_angle({1.0, 2.0}, {3.0, 4.0});
  EXPECT_LE(narrow.lo, std::atan2(1.0, 4.0));
  EXPECT_GE(narrow.hi, std::atan2(2.0, 3.0));
  EXPECT_NEAR(narrow.hi, std::atan2(2.0, 3.0), 1e-14);
}

}  // namespace
}  // namespace blendwright
