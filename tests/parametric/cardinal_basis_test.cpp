#include "parametric/ode/cardinal_basis.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/parametric/random_ode.hpp"

namespace blendwright::test {
namespace {

constexpr double eps = 0x1p-52;

/// Largest |j-th derivative| of function k over [0, 1], sampled closely at the ends, where layers are.
double largest(const CardinalBasis& basis, std::size_t j, std::size_t k) {
  double m = 0.0;
  for (int i = 0; i <= 40; ++i) {
    const double t = i / 40.0, layer = t / std::max(1.0, basis.stiffness());
    for (const double u : {t, layer, 1.0 - layer}) m = std::max(m, std::abs(basis(u).value[j][k]));
  }
  return m;
}

CardinalBasis random_basis(Rng& rng, bool& usable) {
  usable = true;
  const int kind = integer(rng, 0, 2);
  if (kind == 0) return CardinalBasis::repeated_root(log_uniform(rng, 1e-8, 1e4));
  if (kind == 1) return CardinalBasis::sixth_order(random_family(rng), log_uniform(rng, 1e-8, 1e4));
  const auto basis = basis_unless_resonant(
      random_ode(rng, all_regimes[static_cast<std::size_t>(integer(rng, 0, 8))], 1e-4, 1e3));
  usable = basis && basis->kappa() < 1e3;
  return basis ? *basis : CardinalBasis::repeated_root(1.0);
}

TEST(CardinalBasis, MeetsTheEndDataExactly) {
  for_all([](Rng& rng) {
    bool usable = false;
    const CardinalBasis basis = random_basis(rng, usable);
    const std::size_t n = static_cast<std::size_t>(basis.count()), half = n / 2;
    for (std::size_t end = 0; end < 2; ++end) {
      const CardinalValues v = basis(static_cast<double>(end));
      for (std::size_t j = 0; j < half; ++j)
        for (std::size_t k = 0; k < n; ++k) EXPECT_EQ(v.value[j][k], k == j + end * half ? 1.0 : 0.0);
    }
  });
}

TEST(CardinalBasis, ReachesTheEndDataContinuously) {
  // One unit in the last place inside, the formulas themselves are at work: they may differ from the data by
  // their own error, 1e-14 max(1, kappa) of the largest value, and by the slope times the step.
  int tested = 0;
  for_all([&](Rng& rng) {
    bool usable = false;
    const CardinalBasis basis = random_basis(rng, usable);
    if (!usable) return;
    ++tested;
    const std::size_t n = static_cast<std::size_t>(basis.count()), half = n / 2;
    for (std::size_t end = 0; end < 2; ++end) {
      const double step = end == 0 ? 0x1p-53 : eps / 2, u = end == 0 ? step : 1.0 - step;
      const CardinalValues v = basis(u);
      for (std::size_t j = 0; j < half; ++j)
        for (std::size_t k = 0; k < n; ++k) {
          const double datum = k == j + end * half ? 1.0 : 0.0;
          const double allowed = 1e-13 * std::max(1.0, basis.kappa()) * largest(basis, j, k) +
                                 2.0 * step * largest(basis, j + 1, k);
          EXPECT_LE(std::abs(v.value[j][k] - datum), allowed) << "end " << end << " j " << j << " k " << k;
        }
    }
  });
  EXPECT_GT(tested, 100);
}

/// Worst of |phi''' difference quotient - (p phi'' - s phi)| beyond what the quotient's own error allows.
/// Central differences: h^2/6 max|phi^(6)| and the rounding of phi''', 2e-14 max(1, kappa) max|phi'''| / h;
/// phi^(6) follows from the equation itself, phi^(n + 4) = p phi^(n + 2) - s phi^(n).
double residual_excess(const CardinalBasis& basis, double p, double s, double u) {
  const double h = 1e-4 / std::max(1.0, basis.stiffness());
  const CardinalValues lo = basis(u - h), at = basis(u), hi = basis(u + h);
  double excess = -HUGE_VAL;
  for (std::size_t k = 0; k < 4; ++k) {
    const double quotient = (hi.value[3][k] - lo.value[3][k]) / (2.0 * h);
    const double fourth = p * at.value[2][k] - s * at.value[0][k];
    const double m2 = largest(basis, 2, k), m4 = std::abs(p) * m2 + std::abs(s) * largest(basis, 0, k);
    const double m6 = std::abs(p) * m4 + std::abs(s) * m2;
    const double allowed = h * h / 6.0 * m6 + 2e-14 * std::max(1.0, basis.kappa()) * largest(basis, 3, k) / h;
    excess = std::max(excess, std::abs(quotient - fourth) - allowed);
  }
  return excess;
}

TEST(CardinalBasis, SolvesTheSweepEquation) {
  int tested = 0;
  for_all(
      [&](Rng& rng) {
        for (const Regime r : all_regimes) {
          const SweepOde ode = random_ode(rng, r, 0.05, 60.0);
          const auto basis = basis_unless_resonant(ode);
          if (!basis || basis->kappa() > 1e3) continue;
          ++tested;
          const double u = uniform(rng, 0.01, 0.99);
          EXPECT_LE(residual_excess(*basis, -ode.c / ode.b, ode.d / ode.b, u), 0.0)
              << name(r) << " " << ode.b << " " << ode.c << " " << ode.d;
        }
      },
      60);
  EXPECT_GT(tested, 400);
}

TEST(CardinalBasis, DoesNotSolveAnotherEquation) {
  const CardinalBasis basis = CardinalBasis::fourth_order({1.0, -5.0, 1.0});
  EXPECT_LE(residual_excess(basis, 5.0, 1.0, 0.3), 0.0);
  EXPECT_GT(residual_excess(basis, 5.0 * 1.0001, 1.0, 0.3), 0.0);
}

TEST(CardinalBasis, DerivativesAgreeWithDifferences) {
  // Truncation h^2/6 max|phi^(j + 3)| and rounding 1e-13 max(1, kappa) max|phi^(j)| / h. Polynomials of
  // degree 4 have second derivatives of at most 320 times their largest value on [0, 1] (Markov); layers of
  // stiffness r times r^2, and a factor 10 since layer and polynomial may cancel.
  int tested = 0;
  for_all([&](Rng& rng) {
    bool usable = false;
    const CardinalBasis basis = random_basis(rng, usable);
    if (!usable || basis.stiffness() > 1e3) return;
    ++tested;
    const double r = std::max(2.0, basis.stiffness()), h = 1e-4 / r, u = uniform(rng, h, 1.0 - h);
    const CardinalValues lo = basis(u - h), at = basis(u), hi = basis(u + h);
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < static_cast<std::size_t>(basis.count()); ++k) {
        const double quotient = (hi.value[j][k] - lo.value[j][k]) / (2.0 * h);
        const double third = std::max(320.0, 10.0 * r * r) * largest(basis, j + 1, k);
        const double allowed =
            h * h / 6.0 * third + 1e-13 * std::max(1.0, basis.kappa()) * largest(basis, j, k) / h;
        EXPECT_LE(std::abs(quotient - at.value[j + 1][k]), allowed) << "j " << j << " k " << k << " u " << u;
      }
  });
  EXPECT_GT(tested, 80);
}

TEST(CardinalBasis, ReversalSwapsTheEnds) {
  int tested = 0;
  for_all([&](Rng& rng) {
    bool usable = false;
    const CardinalBasis basis = random_basis(rng, usable);
    if (!usable) return;
    ++tested;
    const double u = uniform(rng, 0.0, 1.0), w = 1.0 - u;
    const CardinalValues a = basis(u, w), b = basis(w, u);
    const std::size_t half = static_cast<std::size_t>(basis.count()) / 2;
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < half; ++i) {
        const double sign = (i + j) % 2 == 0 ? 1.0 : -1.0;
        const double allowed = 1e-13 * std::max(1.0, basis.kappa()) * largest(basis, j, i);
        EXPECT_NEAR(a.value[j][i], sign * b.value[j][i + half], allowed);
      }
  });
  EXPECT_GT(tested, 100);
}

/// Largest difference of all functions and derivatives, over their largest values.
double distance(const CardinalBasis& a, const CardinalBasis& b) {
  double d = 0.0;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t k = 0; k < static_cast<std::size_t>(a.count()); ++k) {
      const double scale = largest(a, j, k);
      for (const double u : {0.001, 0.1, 0.37, 0.5, 0.77, 0.98})
        d = std::max(d, std::abs(a(u).value[j][k] - b(u).value[j][k]) / scale);
    }
  return d;
}

TEST(CardinalBasis, RoutesMeetAtTheirSeams) {
  // Parameters a relative step of 1e-13 apart lie on both sides of every seam. The functions change by at
  // most the step times the sensitivity to p and s, of order max(1, p, sqrt s) <= 100 here, and by both
  // routes' own errors.
  const double t = 1e-13, allowed = 100 * t + 5e-14;
  const auto across = [&](double p0, double s0, double p1, double s1) {
    return distance(CardinalBasis::fourth_order({1.0, -p0, s0}), CardinalBasis::fourth_order({1.0, -p1, s1}));
  };
  for (const double x : {-3.0, -1.0, 0.0, 1.0, 3.0}) {
    EXPECT_LE(across(4.0 * (1 - t), x, 4.0 * (1 + t), x), allowed);  // power series to split or product
    EXPECT_LE(across(-4.0 * (1 - t), x, -4.0 * (1 + t), x), allowed);
    EXPECT_LE(across(x, 16.0 * (1 - t), x, 16.0 * (1 + t)), allowed);
    EXPECT_LE(across(x, -16.0 * (1 - t), x, -16.0 * (1 + t)), allowed);
  }
  for (const double p : {5.0, 30.0, -5.0, -20.0}) {
    const double s = 0.0025 * p * p, D = 0.25 * p * p;
    EXPECT_LE(across(p, s * (1 - t), p, s * (1 + t)), allowed) << p;  // split to product
    EXPECT_LE(across(p, D * (1 - t), p, D * (1 + t)), allowed) << p;  // D changes sign
    EXPECT_LE(across(p, D, p, D * (1 + t)), allowed) << p;
    EXPECT_LE(across(p, -1e-13, p, 1e-13), allowed) << p;  // d changes sign
    EXPECT_LE(across(p, 0.0, p, 1e-13), allowed) << p;
  }
  for (const double q : {1.0, 2.0, 3.0})
    EXPECT_LE(distance(CardinalBasis::repeated_root(q * (1 - t)), CardinalBasis::repeated_root(q * (1 + t))),
              allowed);
  for (const auto f : {SixthOrderFamily::tension1, SixthOrderFamily::tension2, SixthOrderFamily::triple})
    EXPECT_LE(
        distance(CardinalBasis::sixth_order(f, 3.0 * (1 - t)), CardinalBasis::sixth_order(f, 3.0 * (1 + t))),
        2 * allowed);
  EXPECT_GT(across(5.0, 6.25, 5.0, 6.25 * (1 + 1e-9)), allowed);  // a step that must be seen
}

TEST(CardinalBasis, RepeatedRootAgreesWithTheGeneralRoute) {
  // b, c, d of q are rounded: a relative step of 2 eps in p and s, times the sensitivity q^2 |dphi/dp| ~ q.
  for_all([](Rng& rng) {
    const double q = log_uniform(rng, 1e-8, 100.0);
    EXPECT_LE(
        distance(CardinalBasis::repeated_root(q), CardinalBasis::fourth_order(SweepOde::repeated_root(q))),
        5e-14 + 20.0 * eps * q);
  });
}

TEST(CardinalBasis, TendsToTheCubicAndTheQuintic) {
  // Error O(M): M = q^2 for the repeated root; the constant is below 1 because |phi''''| <= M max(|phi''|,
  // ..)/8.
  const CardinalBasis cubic = CardinalBasis::fourth_order({1.0, 0.0, 0.0});
  const double u = 0.3;
  EXPECT_NEAR(cubic(u).value[0][0], 2 * u * u * u - 3 * u * u + 1, 4 * eps);
  EXPECT_NEAR(cubic(u).value[0][1], u * u * u - 2 * u * u + u, 4 * eps);
  EXPECT_NEAR(cubic(u).value[0][2], 3 * u * u - 2 * u * u * u, 4 * eps);
  EXPECT_NEAR(cubic(u).value[0][3], u * u * u - u * u, 4 * eps);
  for (const double q : {1e-1, 1e-2, 1e-4, 1e-8}) {
    EXPECT_LE(distance(cubic, CardinalBasis::repeated_root(q)), 10 * q * q + 1e-14) << q;
    const CardinalBasis quintic = CardinalBasis::sixth_order(SixthOrderFamily::quintic, 0.0);
    for (const auto f : {SixthOrderFamily::tension1, SixthOrderFamily::tension2, SixthOrderFamily::triple})
      EXPECT_LE(distance(quintic, CardinalBasis::sixth_order(f, q)), 10 * q * q + 1e-14) << q;
  }
  EXPECT_GT(distance(cubic, CardinalBasis::repeated_root(1.0)), 1e-2);
}

TEST(CardinalBasis, LargeTensionLeavesLayersOnly) {
  // E+: H1 ~ (1 + q w) exp(-q w), K1 ~ -w exp(-q w); D+: the chord.
  for (const double q : {100.0, 1e3, 1e4}) {
    const CardinalBasis basis = CardinalBasis::repeated_root(q);
    const double w = 2.0 / q;
    EXPECT_NEAR(basis(1.0 - w, w).value[0][2], 3.0 * std::exp(-2.0), 1e-13);
    EXPECT_NEAR(basis(1.0 - w, w).value[0][3], -w * std::exp(-2.0), 1e-13 * w);
    EXPECT_LE(std::abs(basis(0.5).value[0][2]), (1 + q / 2) * std::exp(-q / 2) * (1 + 1e-12));
    EXPECT_NEAR(CardinalBasis::fourth_order(SweepOde::tension(q))(0.3).value[0][2], 0.3, 2.0 / q);
  }
}

TEST(CardinalBasis, ReproducesTheSpanOfItsRegime) {
  // Any solution is the sum of its own end data times the functions. Tension spline: 1, u; sixth order: 1, u
  // (and u^2, u^3 for tension1 and quintic). Rounding: six terms of order 1.
  for_all([](Rng& rng) {
    const double q = log_uniform(rng, 1e-4, 1e4), u = uniform(rng, 0.0, 1.0);
    const CardinalValues line = CardinalBasis::fourth_order(SweepOde::tension(q))(u);
    EXPECT_NEAR(line.value[0][0] + line.value[0][2], 1.0, 1e-13);
    EXPECT_NEAR(line.value[0][1] + line.value[0][2] + line.value[0][3], u, 1e-13);
    const CardinalValues cubic =
        CardinalBasis::sixth_order(SixthOrderFamily::tension1, q)(u);  // u^3: 1, 3, 6 at u = 1
    EXPECT_NEAR(cubic.value[0][3] + 3 * cubic.value[0][4] + 6 * cubic.value[0][5], u * u * u, 1e-13);
    const CardinalValues lines = CardinalBasis::sixth_order(SixthOrderFamily::tension2, q)(u);
    EXPECT_NEAR(lines.value[0][0] + lines.value[0][3], 1.0, 1e-13);
  });
  const CardinalValues paper = CardinalBasis::repeated_root(3.0)(0.5);
  EXPECT_LT(paper.value[0][0] + paper.value[0][2],
            0.99);  // constants are not solutions in the paper's regime
}

TEST(CardinalBasis, KnowsItsStiffness) {
  EXPECT_DOUBLE_EQ(CardinalBasis::fourth_order({1.0, -5.0, 4.0}).stiffness(), 2.0);  // L = 1, 4
  EXPECT_DOUBLE_EQ(CardinalBasis::fourth_order({2.0, 0.0, 32.0}).stiffness(), 2.0);  // |L|^2 = 16
  EXPECT_DOUBLE_EQ(CardinalBasis::fourth_order(SweepOde::tension(7.0)).stiffness(), 7.0);
  EXPECT_DOUBLE_EQ(CardinalBasis::repeated_root(9.0).stiffness(), 9.0);
  EXPECT_DOUBLE_EQ(CardinalBasis::sixth_order(SixthOrderFamily::triple, 5.0).stiffness(), 5.0);
}

TEST(CardinalBasis, RefusesRootsThatAreNone) {
  EXPECT_THROW((void)CardinalBasis::repeated_root(-1.0), InputError);
  EXPECT_THROW((void)CardinalBasis::repeated_root(std::nan("")), InputError);
  EXPECT_THROW((void)CardinalBasis::sixth_order(SixthOrderFamily::triple, HUGE_VAL), InputError);
  EXPECT_NO_THROW((void)CardinalBasis::repeated_root(0.0));
}

}  // namespace
}  // namespace blendwright::test
