// Sampled maxima become true local maxima.
#include "verify/continuity/local_maximum.hpp"

#include <gtest/gtest.h>

#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using detail::local_maximum;
using detail::Peak;
using detail::polished_maximum;
using test::for_all;
using test::Rng;
using test::uniform;

template <class F>
Peak refined(F f, double lo, double hi, double start) {
  return polished_maximum(f, lo, hi, local_maximum(f, lo, hi, {start, f(start)}));
}

TEST(LocalMaximum, IsFoundToTwelveDigitsOfTheRange) {
  // a cos(k (v - top)) + a/4 over a range of about one sampling step, in which it bends by (k range)^2 / 8 of
  // its height: rounding of 2^-52 moves the place by 2^-52 (5/4) / (h range k^2) of the range, h = range/8 at
  // least half of the time and never below range/12 here; with k range >= 1 that is below 1e-14.
  for_all([](Rng& rng) {
    const double lo = uniform(rng, -3.0, 3.0), range = uniform(rng, 1e-3, 1.0), hi = lo + range;
    const double top = lo + range * uniform(rng, 0.25, 0.75), k = uniform(rng, 1.0, 1.5) / range;
    const double height = test::log_uniform(rng, 1e-9, 1e3);
    const auto f = [&](double v) { return height * (std::cos(k * (v - top)) + 0.25); };
    const Peak peak = refined(f, lo, hi, lo + 0.5 * range);
    // Places themselves round by 2^-53 of at most 4, against a range of 1e-3: 5e-13 for the six of them.
    EXPECT_NEAR(peak.at, top, 1e-12 * range + 4.0 * 0x1p-52);
    EXPECT_LE(std::abs(peak.value - 1.25 * height), 1e-15 * height);
    // The control: without the last steps the place is only as near as asked for, a thousandth of the range.
    const Peak rough = local_maximum(f, lo, hi, {lo + 0.5 * range, f(lo + 0.5 * range)});
    EXPECT_GE(peak.value, rough.value * (1.0 - 1e-15));
  });
}

TEST(LocalMaximum, IsRoughWithoutTheLastSteps) {
  const auto f = [](double v) { return std::cos(v - 0.3) + 0.1 * (v - 0.3) * (v - 0.3) * (v - 0.3); };
  const Peak rough = local_maximum(f, 0.0, 1.0, {0.5, f(0.5)}), fine = polished_maximum(f, 0.0, 1.0, rough);
  EXPECT_GT(std::abs(rough.at - 0.3), 1e-9);
  EXPECT_LT(std::abs(fine.at - 0.3), 1e-12);
}

TEST(LocalMaximum, OfAnAsymmetricPeakIsWhereItsSlopeVanishes) {
  // v e^(-v) on [0, 3]: at v = 1. The differences' own error, h^6/140 f^(7)(1) / f''(1) = h^6 6/140, is below
  // 1.3e-4 for h = 3/8, and Newton's method converges to their zero: this range is too wide for twelve
  // digits.
  const auto f = [](double v) { return v * std::exp(-v); };
  EXPECT_NEAR(refined(f, 0.0, 3.0, 2.0).at, 1.0, 3e-4);
  EXPECT_NEAR(refined(f, 0.95, 1.07, 1.05).at, 1.0, 1e-12);
}

TEST(LocalMaximum, OfRoundingAndPlateausEnds) {
  int calls = 0;
  Rng rng(5);
  const auto noise = [&](double) {
    ++calls;
    return 1e-16 * uniform(rng, 0.0, 1.0);
  };
  (void)refined(noise, 0.0, 1.0, 0.5);
  const auto flat = [&](double) {
    ++calls;
    return 1.0;
  };
  EXPECT_EQ(refined(flat, 0.0, 1.0, 0.5).value, 1.0);
  EXPECT_LT(calls, 400);  // 100 bracketing steps and 12 of 7 calls each, twice
  const auto nan = [](double v) { return v > 0.6 ? std::nan("") : v; };
  EXPECT_LE(refined(nan, 0.0, 1.0, 0.5).at, 1.0);
}

TEST(LocalMaximum, AtAKinkOrAnEndStaysWhereTheBracketFoundIt) {
  const auto kink = [](double v) { return 1.0 - std::abs(v - 0.37); };
  const Peak peak = refined(kink, 0.0, 1.0, 0.5);
  EXPECT_NEAR(peak.at, 0.37, 1e-3);
  EXPECT_GE(peak.value, 1.0 - 1e-3);
  const auto rising = [](double v) { return v * v; };
  EXPECT_NEAR(refined(rising, 0.0, 1.0, 0.5).at, 1.0, 1e-3);
}

}  // namespace
}  // namespace blendwright
