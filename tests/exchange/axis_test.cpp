#include "kernel/exchange/axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::Rng;
using test::uniform;

TEST(LinearAxis, CoversTheRangeWithEvenTicks) {
  test::for_all([](Rng& rng) {
    const double size = std::pow(10.0, uniform(rng, -12.0, 12.0));
    const double a = uniform(rng, -size, size), b = a + uniform(rng, 0.01, 1.0) * size;
    const Axis axis = linear_axis({a, b, 0.0}, 7);
    // A tick may miss the end by 1e-9 of a step, which is at most the length of the axis.
    const double slack = 1e-9 * (axis.hi - axis.lo);
    EXPECT_LE(axis.lo, a + slack);
    EXPECT_GE(axis.hi, b - slack);
    ASSERT_GE(axis.ticks.size(), 3u);
    EXPECT_LE(axis.ticks.size(), 10u);  // 7 intervals over the range, one more beyond each end
    const double step = axis.ticks[1].value - axis.ticks[0].value;
    for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
      EXPECT_NEAR(axis.ticks[i].value, axis.ticks[0].value + step * static_cast<double>(i), slack);
      EXPECT_FALSE(axis.ticks[i].label.empty());
      for (std::size_t j = 0; j < i; ++j) EXPECT_NE(axis.ticks[i].label, axis.ticks[j].label);
    }
  });
}

TEST(LinearAxis, EndsAtTheRangeWhenFitted) {
  const Axis axis = linear_axis({0.1, 6.28, 0.1}, 6, true);
  EXPECT_EQ(axis.lo, 0.1);
  EXPECT_EQ(axis.hi, 6.28);
  EXPECT_NE(linear_axis({0.1, 6.28, 0.1}, 6, false).hi, 6.28);
}

TEST(LinearAxis, HasRoomAroundAConstant) {
  for (const double c : {0.0, 3.0, -2e-9}) {
    const Axis axis = linear_axis({c, c, std::max(c, 0.0)}, 5);
    EXPECT_LT(axis.lo, c);
    EXPECT_GT(axis.hi, c);
  }
}

TEST(LogAxis, HasWholeDecadesAndAtMostSoManyOfThem) {
  test::for_all([](Rng& rng) {
    const double least = std::pow(10.0, uniform(rng, -30.0, 3.0));
    const double most = least * std::pow(10.0, uniform(rng, 0.0, 30.0));
    const Axis axis = log_axis({0.0, most, least}, 8, 5);
    EXPECT_EQ(axis.lo, std::round(axis.lo));
    EXPECT_EQ(axis.hi, std::round(axis.hi));
    EXPECT_GE(axis.hi - axis.lo, 1.0);
    EXPECT_LE(axis.hi - axis.lo, 8.0);
    EXPECT_LE(std::log10(most), axis.hi + 1e-8);
    EXPECT_GE(axis.lo, -16.0);
    EXPECT_FALSE(axis.ticks.front().label.empty());
  });
}

TEST(LogAxis, PutsZeroAtTheBottomAndDecadesInEqualSteps) {
  const Axis axis = log_axis({0.0, 1e-4, 1e-8}, 8, 5);
  EXPECT_EQ(axis.position(0.0), 0.0);
  EXPECT_EQ(axis.position(-1.0), 0.0);
  EXPECT_EQ(axis.position(1e-20), 0.0);
  EXPECT_EQ(axis.position(1.0), 1.0);
  EXPECT_NEAR(axis.position(1e-6), 0.5, 1e-15 * 16.0);  // rounding of a log10 of size 16
  EXPECT_EQ(log_axis({0.0, 0.0, 0.0}, 8, 5).position(0.0), 0.0);
}

TEST(RangeOfValues, LeavesOutWhatIsNotFinite) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const ValueRange range = range_of({nan, 3.0, -1.0, infinity, 0.5});
  EXPECT_EQ(range.least, -1.0);
  EXPECT_EQ(range.most, 3.0);
  EXPECT_EQ(range.least_positive, 0.5);
  EXPECT_EQ(range_of({nan}).most, 0.0);
}

TEST(QuantityText, IsShort) {
  EXPECT_EQ(quantity_text(0.0), "0");
  EXPECT_EQ(quantity_text(0.001), "0.001");
  EXPECT_EQ(quantity_text(1e-6), "10^-6");
  EXPECT_EQ(quantity_text(2.5e-8), "2.5x10^-8");
  EXPECT_EQ(quantity_text(120.0), "120");
}

}  // namespace
}  // namespace blendwright
