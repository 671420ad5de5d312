// Second derivatives of the cardinal functions at the ends, as proven bounds.
#include "parametric/ode/cardinal_ends.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/parametric/random_ode.hpp"
#include "tests/support/golden.hpp"

namespace blendwright::test {
namespace {

double largest(const EndBends& bends) {
  double most = 0.0;
  for (const auto& end : bends.value)
    for (const Bounds& b : end) most = std::max(most, b.magnitude());
  return most;
}

double widest(const EndBends& bends) {
  double most = 0.0;
  for (const auto& end : bends.value)
    for (const Bounds& b : end) most = std::max(most, b.hi - b.lo);
  return most;
}

/// Whether every value, times `factor`, lies within its bounds but for `slack` of the largest.
bool inside(const EndBends& bends, std::size_t end, const auto& value, double factor, double slack) {
  const double room = slack * largest(bends);
  for (std::size_t k = 0; k < 4; ++k) {
    const Bounds& b = bends.value[end][k];
    if (!(b.lo - room <= factor * value[k] && factor * value[k] <= b.hi + room)) return false;
  }
  return true;
}

TEST(EndBends, ContainTheGoldenValues) {
  // Golden values are decimals of 17 digits, read to half a unit in the last place: 2^-53 of themselves, of
  // which the largest is the largest.
  int compared = 0;
  for (const CardinalCase& c : read_sweep_golden(golden_folder()).cardinal) {
    const EndBends bends = c.by_root ? end_bends(c.q) : end_bends(c.ode);
    const double kappa =
        (c.by_root ? CardinalBasis::repeated_root(c.q) : CardinalBasis::fourth_order(c.ode)).kappa();
    EXPECT_LE(widest(bends), 1e-12 * std::max(1.0, kappa) * largest(bends)) << c.label;
    for (std::size_t i = 0; i < c.u.size(); ++i) {
      if (c.u[i] != 0.0 && c.u[i] != 1.0) continue;
      const std::size_t end = c.u[i] == 0.0 ? 0 : 1;
      EXPECT_TRUE(inside(bends, end, c.derivative[2][i], 1.0, 0x1p-52)) << c.label << " end " << end;
      ++compared;
      if (kappa < 100.0) {
        EXPECT_FALSE(inside(bends, end, c.derivative[2][i], 1.0 + 1e-9, 0x1p-52)) << c.label;
        EXPECT_FALSE(inside(bends, end, c.derivative[2][i], 1.0 - 1e-9, 0x1p-52)) << c.label;
      }
    }
  }
  EXPECT_GT(compared, 50);
}

TEST(EndBends, ContainWhatTheBasisEvaluates) {
  // CardinalBasis is held to 1e-14 max(1, kappa) of the largest |phi''| over [0, 1], in regime A to five
  // times that; the largest is at an end but for oscillations, which reach further by a factor below 10.
  int tested = 0;
  for_all([&](Rng& rng) {
    for (const Regime r : all_regimes) {
      const SweepOde ode = random_ode(rng, r, 1e-4, 300.0);
      const auto basis = basis_unless_resonant(ode);
      if (!basis || basis->kappa() > 100.0) continue;
      ++tested;
      const EndBends bends = end_bends(ode);
      EXPECT_LE(widest(bends), 1e-10 * largest(bends)) << name(r);
      const double slack = 5e-13 * std::max(1.0, basis->kappa());
      for (std::size_t end = 0; end < 2; ++end) {
        const auto value = (*basis)(static_cast<double>(end)).value[2];
        EXPECT_TRUE(inside(bends, end, value, 1.0, slack))
            << name(r) << " b " << ode.b << " c " << ode.c << " d " << ode.d;
        EXPECT_FALSE(inside(bends, end, value, 1.0 + 1e-9, slack)) << name(r);
      }
    }
    const double q = log_uniform(rng, 1e-8, 1e4);
    for (std::size_t end = 0; end < 2; ++end) {
      const auto value = CardinalBasis::repeated_root(q)(static_cast<double>(end)).value[2];
      EXPECT_TRUE(inside(end_bends(q), end, value, 1.0, 5e-14)) << "q " << q;
      EXPECT_FALSE(inside(end_bends(q), end, value, 1.0 + 1e-9, 5e-14)) << "q " << q;
    }
  });
  EXPECT_GT(tested, 100);
}

TEST(EndBends, AreTheSameAcrossTheirRoutes) {
  // Just below and above |p| = 4 and sqrt s = |p|/20 the closed forms change; the functions do not, by more
  // than their slopes there: below 10 per unit of p.
  const auto apart = [](const SweepOde& a, const SweepOde& b) {
    const EndBends x = end_bends(a), y = end_bends(b);
    double most = 0.0;
    for (std::size_t e = 0; e < 2; ++e)
      for (std::size_t k = 0; k < 4; ++k)
        most = std::max(most, std::abs(x.value[e][k].middle() - y.value[e][k].middle()));
    return most;
  };
  constexpr double step = 1e-9;
  for (const double sign : {-1.0, 1.0})
    for (const double s : {-3.0, 0.0, 1e-3, 2.0, 4.0})
      EXPECT_LE(apart({1.0, sign * (4.0 - step), s}, {1.0, sign * (4.0 + step), s}), 20.0 * step);
  EXPECT_LE(apart({1.0, -20.0, 1.0 - step}, {1.0, -20.0, 1.0 + step}), 20.0 * step);
}

TEST(EndBends, OfTheRepeatedRootAreThoseOfItsEquation) {
  // q = 3/2: c = -9/2 and d = 81/16 are exact.
  const EndBends a = end_bends(1.5), b = end_bends(SweepOde::repeated_root(1.5));
  for (std::size_t e = 0; e < 2; ++e)
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_LE(a.value[e][k].lo, b.value[e][k].hi);
      EXPECT_GE(a.value[e][k].hi, b.value[e][k].lo);
    }
}

TEST(EndBends, AreUnknownAtAResonance) {
  // Regime D-, om = 2 pi: singular for the exact om; the nearest doubles are within rounding of it.
  const double om = 2.0 * std::acos(-1.0);
  const EndBends bends = end_bends({1.0, om * om, 0.0});
  EXPECT_FALSE(std::isfinite(largest(bends)) && widest(bends) < 1e3);
}

}  // namespace
}  // namespace blendwright::test
