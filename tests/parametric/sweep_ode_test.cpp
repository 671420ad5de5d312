#include "parametric/ode/sweep_ode.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/parametric/random_ode.hpp"

namespace blendwright::test {
namespace {

TEST(SweepRegime, FollowsTheSignsOfTheTable) {
  for_all([](Rng& rng) {
    for (const Regime r : all_regimes) {
      const SweepOde ode = random_ode(rng, r, 0.01, 100.0);
      EXPECT_EQ(regime(ode), r) << name(r) << " " << ode.b << " " << ode.c << " " << ode.d;
    }
  });
}

TEST(SweepRegime, IgnoresACommonFactor) {
  for_all([](Rng& rng) {
    for (const Regime r : all_regimes) {
      const SweepOde ode = random_ode(rng, r, 0.01, 100.0);
      const double f = std::ldexp(integer(rng, 0, 1) == 0 ? -1.0 : 1.0, integer(rng, -300, 300));
      EXPECT_EQ(regime({f * ode.b, f * ode.c, f * ode.d}), r);
    }
  });
}

TEST(SweepRegime, SeesTheLastBitOfTheDiscriminant) {
  // c^2 - 4bd = (c0 + ulp)^2 - c0^2 is far below the rounding of either product when c has 53 bits.
  const double c = 3.0, d = 2.25;
  EXPECT_EQ(regime({1.0, -c, d}), Regime::Eplus);
  EXPECT_EQ(regime({1.0, -std::nextafter(c, 4.0), d}), Regime::A);
  EXPECT_EQ(regime({1.0, -std::nextafter(c, 2.0), d}), Regime::F);
  EXPECT_EQ(regime({1.0, std::nextafter(c, 4.0), d}), Regime::C);
  const double odd = 1.0 + 0x1p-52, square_rounded_down = odd * odd;  // the product loses 2^-104
  EXPECT_EQ(regime({0.25, odd, square_rounded_down}), Regime::C);
}

TEST(SweepRegime, TensionAndRepeatedRootAreWhatTheySay) {
  EXPECT_EQ(regime(SweepOde::tension(5.0)), Regime::Dplus);
  EXPECT_EQ(regime(SweepOde::tension(0.0)), Regime::E0);
  EXPECT_EQ(regime(SweepOde::repeated_root(3.0)), Regime::Eplus);
}

TEST(SweepRegime, RefusesWhatIsNoEquationOfOrderFour) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto where = [](const SweepOde& ode) -> std::string {
    try {
      (void)regime(ode);
    } catch (const InputError& e) {
      return e.problems().at(0).where;
    }
    return "accepted";
  };
  EXPECT_EQ(where({0.0, 1.0, 1.0}), "b");
  EXPECT_EQ(where({nan, 1.0, 1.0}), "b");
  EXPECT_EQ(where({1.0, inf, 1.0}), "c");
  EXPECT_EQ(where({1.0, 1.0, -nan}), "d");
  EXPECT_EQ(where({1e-300, 1e300, 1.0}), "b");
  EXPECT_EQ(where({1.0, 1.0, 1.0}), "accepted");
}

/// om is a root of tan(om/2) = om/2 or sin(om/2) = 0; the equation with c = om^2, d = 0 is singular there.
TEST(SweepResonance, NamesFamilyRegimeAndNearestMode) {
  const double om = 8.98681891581813;
  for (const double off : {0.0, 1e-11, -1e-11}) {
    const double x = om * (1.0 + off);
    try {
      (void)CardinalBasis::fourth_order({2.0, 2.0 * x * x, 0.0});
      FAIL() << "accepted";
    } catch (const ResonanceError& e) {
      EXPECT_EQ(e.family, "odd");
      EXPECT_EQ(e.root_regime, Regime::Dminus);
      EXPECT_GT(e.kappa, 1e8);
      EXPECT_NEAR(e.nearest_mode, om, 1e-13 * om);  // om is given to 15 digits
      EXPECT_NE(std::string(e.what()).find("odd family"), std::string::npos);
    }
  }
  try {
    const double x = 4.0 * std::numbers::pi;
    (void)CardinalBasis::fourth_order({1.0, x * x, 0.0});
    FAIL() << "accepted";
  } catch (const ResonanceError& e) {
    EXPECT_EQ(e.family, "even");
    EXPECT_NEAR(e.nearest_mode, 4.0 * std::numbers::pi, 1e-13);
  }
}

TEST(SweepResonance, NeverComesWithoutOscillation) {
  for_all([](Rng& rng) {
    for (const Regime r : {Regime::A, Regime::Dplus, Regime::E0, Regime::Eplus, Regime::Eminus, Regime::F}) {
      const SweepOde ode = random_ode(rng, r, 1e-3, 1e3);
      // In regime A the common factor of both roots makes up to about 4 (measured bound of the product form).
      EXPECT_LE(CardinalBasis::fourth_order(ode).kappa(), 10.0)
          << name(r) << " " << ode.c / ode.b << " " << ode.d / ode.b;
    }
  });
}

TEST(SweepResonance, StaysOutsideTheSafeSet) {
  // max(c,0)/(4 pi^2) + max(-d,0)/500.5639 < 1 with b = 1: the energy is positive definite, no singular
  // problem.
  for_all([](Rng& rng) {
    const double share = uniform(rng, 0.0, 0.98), part = uniform(rng, 0.0, 1.0);
    const double c = share * part * 4.0 * std::numbers::pi * std::numbers::pi,
                 d = -share * (1.0 - part) * 500.563901740432;
    EXPECT_LT(CardinalBasis::fourth_order({1.0, c, d}).kappa(), 1e3);
  });
}

}  // namespace
}  // namespace blendwright::test
