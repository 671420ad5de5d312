// Cardinal functions and resonances against golden data (tests/data/golden/README.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "parametric/ode/cardinal_basis.hpp"
#include "parametric/ode/characteristic.hpp"
#include "tests/support/golden.hpp"

namespace blendwright::test {
namespace {

const SweepGolden& golden() {
  static const SweepGolden all = read_sweep_golden(golden_folder());
  return all;
}

/// Largest |computed - golden| over the column maximum, over all columns of one derivative.
double worst_error(const CardinalBasis& basis, const std::vector<double>& u, const Table& table,
                   std::size_t j) {
  double worst = 0.0;
  for (std::size_t k = 0; k < table.front().size(); ++k) {
    double error = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double computed = basis(u[i]).value[j][k];
      if (!std::isfinite(computed)) return HUGE_VAL;
      error = std::max(error, std::abs(computed - table[i][k]));
      largest = std::max(largest, std::abs(table[i][k]));
    }
    worst = std::max(worst, largest > 0.0 ? error / largest : (error > 0.0 ? HUGE_VAL : 0.0));
  }
  return worst;
}

CardinalBasis basis_of(const CardinalCase& c) {
  return c.by_root ? CardinalBasis::repeated_root(c.q) : CardinalBasis::fourth_order(c.ode);
}

double tolerance(const CardinalCase& c, const CardinalBasis& basis) {
  double per_kappa = 1e-14;
  if (c.regime == "A") {
    const auto [L1, L2] = detail::real_squares(detail::characteristic(c.ode));
    if (L1 > 100.0 * L2) per_kappa = 5e-14;
  }
  return per_kappa * std::max(1.0, basis.kappa());
}

std::optional<SixthOrderFamily> family_of(const std::string& kind) {
  for (const auto f : {SixthOrderFamily::quintic, SixthOrderFamily::tension1, SixthOrderFamily::tension2,
                       SixthOrderFamily::triple})
    if (kind == name(f)) return f;
  return std::nullopt;
}

TEST(CardinalGolden, HasCases) {
  EXPECT_GT(golden().cardinal.size() + golden().sixth_order.size() + golden().resonances.size() +
                golden().examples.size(),
            0u);
}

TEST(CardinalGolden, FourthOrderFunctionsAgree) {
  for (const CardinalCase& c : golden().cardinal) {
    SCOPED_TRACE(c.label);
    EXPECT_EQ(c.regime, c.by_root ? "E+" : name(regime(c.ode)));
    const CardinalBasis basis = basis_of(c);
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_LE(worst_error(basis, c.u, c.derivative[j], j), tolerance(c, basis)) << "derivative " << j;
  }
}

TEST(CardinalGolden, ConditionNumbersDoNotExcuseErrors) {
  // The tolerance grows with kappa, so kappa itself must be small where nothing can resonate.
  for (const CardinalCase& c : golden().cardinal)
    if (c.regime != "B" && c.regime != "C" && c.regime != "D-") {
      EXPECT_LE(basis_of(c).kappa(), 10.0) << c.label;
    }
}

TEST(CardinalGolden, AnotherEquationIsNoticed) {
  // Negative control: an equation whose p is off by 1e-9 misses the tolerance somewhere.
  std::size_t noticed = 0, tried = 0;
  for (CardinalCase c : golden().cardinal) {
    if (c.by_root || std::abs(c.ode.c / c.ode.b) < 1.0) continue;
    c.ode.c *= 1.0 + 1e-9;
    const CardinalBasis basis = basis_of(c);
    double worst = 0.0;
    for (std::size_t j = 0; j < 4; ++j) worst = std::max(worst, worst_error(basis, c.u, c.derivative[j], j));
    ++tried;
    if (worst > 1e-14 * std::max(1.0, basis.kappa())) ++noticed;
  }
  EXPECT_EQ(noticed, tried);
}

TEST(CardinalGolden, RepeatedRootIsAccurateAtEveryPoint) {
  // Relative to the value itself, also at the double zeros. exp(-q t) with q t rounded to eps q t carries
  // that much relative error; 10 eps for the rest of the arithmetic (q = 1.0 loses a factor of about 7 in D).
  for (const CardinalCase& c : golden().cardinal) {
    if (!c.by_root) continue;
    SCOPED_TRACE(c.label);
    const CardinalBasis basis = basis_of(c);
    for (std::size_t i = 0; i < c.u.size(); ++i) {
      const CardinalValues v = basis(c.u[i]);
      for (std::size_t k = 0; k < 4; ++k) {
        const double exact = c.derivative[0][i][k], depth = c.q * std::max(c.u[i], 1.0 - c.u[i]);
        if (std::abs(exact) < 1e-290) continue;  // rounded to a subnormal, or to 0, on the way
        EXPECT_LE(std::abs(v.value[0][k] / exact - 1.0), (10.0 + 2.0 * depth) * 1.2e-16)
            << "u " << c.u[i] << " k " << k;
      }
    }
  }
}

TEST(CardinalGolden, SixthOrderFunctionsAgree) {
  for (const SixthOrderCase& c : golden().sixth_order) {
    SCOPED_TRACE(c.kind + " q = " + std::to_string(c.q));
    const auto family = family_of(c.kind);
    ASSERT_TRUE(family) << "unknown kind";
    const CardinalBasis basis = CardinalBasis::sixth_order(*family, c.q);
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_LE(worst_error(basis, c.u, c.derivative[j], j), 1e-13) << "derivative " << j;
  }
}

/// The equation whose singular parameter is listed under `key`, as a function of that parameter.
struct ResonantFamily {
  double L1 = 0.0;            ///< the fixed squared root
  bool clamped_beam = false;  ///< L1 = x^2 as well
  std::string parity;
  Regime regime = Regime::B;
  [[nodiscard]] SweepOde ode(double x) const {
    const double first = clamped_beam ? x * x : L1;
    return {1.0, x * x - first, -first * x * x};
  }
};

std::optional<ResonantFamily> family_of_key(const std::string& key) {
  if (key == "B_c0_clamped_beam") return ResonantFamily{0.0, true, "", Regime::B};
  const std::string parity = key.find("_even") != std::string::npos ? "even" : "odd";
  if (key == "D_minus_" + parity) return ResonantFamily{0.0, false, parity, Regime::Dminus};
  const auto fixed = [&](const std::string& before, const std::string& after) -> std::optional<double> {
    const std::size_t tail = key.size() - std::min(key.size(), after.size());
    if (key.compare(0, before.size(), before) != 0 || key.compare(tail, std::string::npos, after) != 0)
      return std::nullopt;
    return std::stod(key.substr(before.size(), tail - before.size()));
  };
  if (const auto al = fixed("B_alpha", "_" + parity + "_omega"))
    return ResonantFamily{*al * *al, false, parity, Regime::B};
  if (const auto om = fixed("C_omega1_", "_" + parity + "_omega2"))
    return ResonantFamily{-*om * *om, false, parity, Regime::C};
  return std::nullopt;
}

TEST(CardinalGolden, ResonancesAreRefusedAndOnlyThey) {
  for (const auto& [key, modes] : golden().resonances) {
    SCOPED_TRACE(key);
    const auto family = family_of_key(key);
    ASSERT_TRUE(family) << "unknown key";
    for (const double x : modes) {
      SCOPED_TRACE(x);
      bool refused = false;
      for (const double off : {0.0, 1e-10, -1e-10, 1e-9, -1e-9}) try {
          (void)CardinalBasis::fourth_order(family->ode(x * (1.0 + off)));
        } catch (const ResonanceError& e) {
          refused = true;
          EXPECT_GT(e.kappa, 1e8);
          EXPECT_EQ(e.root_regime, family->regime);
          if (!family->parity.empty()) {
            EXPECT_EQ(e.family, family->parity);
          }
          // The bracketed root is good to rounding; the fixed root moves with x for the beam only.
          EXPECT_NEAR(e.nearest_mode, x, (family->clamped_beam ? 3e-9 : 1e-12) * x);
        }
      EXPECT_TRUE(refused);
      for (const double off : {0.01, -0.01})
        EXPECT_NO_THROW((void)CardinalBasis::fourth_order(family->ode(x * (1.0 + off))));
    }
  }
}

}  // namespace
}  // namespace blendwright::test
