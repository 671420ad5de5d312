#include <gtest/gtest.h>

#include <cmath>

#include "parametric/shape_fit/cardinal_sensitivity.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::detail {
namespace {

using namespace test;

/// Largest difference between W and the difference quotient of the basis along the parameter, relative to the
/// largest value of the same derivative.
template <class Basis>
double disagreement(const Basis& basis, double l, const EvenOperator& a, const EvenOperator& by) {
  const CardinalBasis at = basis(l);
  const CardinalSensitivity W(at, a, {by});
  // Central difference of sixth order: error h^6 f^(7)/140 of values of size l^-6, rounding 1e-14 l / h.
  const double h = 0.02 * l;
  std::array<CardinalBasis, 6> near{basis(l + h),       basis(l - h),       basis(l + 2.0 * h),
                                    basis(l - 2.0 * h), basis(l + 3.0 * h), basis(l - 3.0 * h)};
  double worst = 0.0;
  for (std::size_t j = 0; j < 4; ++j) {
    double size = 0.0, error = 0.0;
    for (int i = 0; i <= 20; ++i) {
      const double u = i / 20.0;
      const CardinalValues value = W.at(0, modes_at(at.count() / 2, u));
      std::array<CardinalValues, 6> f;
      for (std::size_t n = 0; n < 6; ++n) f[n] = near[n](u);
      for (std::size_t k = 0; k < static_cast<std::size_t>(at.count()); ++k) {
        const auto d = [&](std::size_t n) { return f[n].value[j][k] - f[n + 1].value[j][k]; };
        const double difference = (45.0 * d(0) - 9.0 * d(2) + d(4)) / (60.0 * h);
        size = std::max({size, std::abs(difference), std::abs(f[0].value[j][k]) / l});
        error = std::max(error, std::abs(value.value[j][k] - difference));
      }
    }
    worst = std::max(worst, error / size);
  }
  return worst;
}

// Differences: about 0.02^6 of the size, 6e-11; rounding 1e-14 / 0.02 times the largest derivative, 1e-12.
constexpr double difference_error = 2e-9;

TEST(CardinalSensitivity, OfTheDoubleRootAgreesWithDifferences) {
  for (const double q : {0.1, 1.0, 3.0, 10.0, 50.0}) {
    const double l = q * q;
    const auto basis = [](double x) { return CardinalBasis::repeated_root(std::sqrt(x)); };
    EXPECT_LE(disagreement(basis, l, {l * l, -2.0 * l, 0.0}, {2.0 * l, -2.0, 0.0}), difference_error) << q;
    // Negative control: the derivative of another equation, where l matters.
    if (q >= 1.0) {
      EXPECT_GT(disagreement(basis, l, {l * l, -2.0 * l, 0.0}, {0.0, -2.0, 0.0}), 1e-3) << q;
    }
  }
}

TEST(CardinalSensitivity, OfTheTensionSplineAgreesWithDifferences) {
  for (const double q : {0.5, 2.0, 10.0, 50.0}) {
    const double l = q * q;
    const auto basis = [](double x) { return CardinalBasis::fourth_order({1.0, -x, 0.0}); };
    EXPECT_LE(disagreement(basis, l, {0.0, -l, 0.0}, {0.0, -1.0, 0.0}), difference_error) << q;
  }
}

TEST(CardinalSensitivity, OfBothCoefficientsAgreesWithDifferences) {
  for_all(
      [](Rng& rng) {
        const double p = log_uniform(rng, 0.1, 2000.0), s = log_uniform(rng, 0.1, 1e5);
        const auto by_p = [&](double x) { return CardinalBasis::fourth_order({1.0, -x, s}); };
        const auto by_s = [&](double x) { return CardinalBasis::fourth_order({1.0, -p, x}); };
        EXPECT_LE(disagreement(by_p, p, {s, -p, 0.0}, {0.0, -1.0, 0.0}), difference_error);
        EXPECT_LE(disagreement(by_s, s, {s, -p, 0.0}, {1.0, 0.0, 0.0}), difference_error);
      },
      20);
}

TEST(CardinalSensitivity, OfSixthOrderAgreesWithDifferences) {
  for (const double q : {0.3, 1.0, 2.9, 3.1, 10.0, 40.0}) {
    const double l = q * q;
    const auto family = [](SixthOrderFamily f) {
      return [f](double x) { return CardinalBasis::sixth_order(f, std::sqrt(x)); };
    };
    // The functions themselves are known to 5e-14 of the largest derivative, here divided by h.
    EXPECT_LE(disagreement(family(SixthOrderFamily::tension1), l, {0.0, 0.0, -l}, {0.0, 0.0, -1.0}),
              difference_error)
        << q;
    EXPECT_LE(
        disagreement(family(SixthOrderFamily::tension2), l, {0.0, l * l, -2.0 * l}, {0.0, 2.0 * l, -2.0}),
        difference_error)
        << q;
    EXPECT_LE(disagreement(family(SixthOrderFamily::triple), l, {-l * l * l, 3.0 * l * l, -3.0 * l},
                           {-3.0 * l * l, 6.0 * l, -3.0}),
              difference_error)
        << q;
  }
}

}  // namespace
}  // namespace blendwright::detail
