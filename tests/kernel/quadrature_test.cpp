#include "kernel/math/quadrature.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

constexpr double eps = 2.220446049250313e-16;

double integral_of_power(const QuadratureRule& rule, int k) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.x.size(); ++i) sum += rule.w[i] * std::pow(rule.x[i], k);
  return sum;
}

TEST(GaussLegendre, IsExactToDegreeTwiceItsPointsMinusOneAndNoFurther) {
  for (int n = 1; n <= 64; ++n) {
    const QuadratureRule& rule = gauss_legendre(n);
    ASSERT_EQ(rule.x.size(), static_cast<std::size_t>(n));
    // x^k amplifies the rounding of a node by k; weights carry a few roundings more.
    for (int k = 0; k <= 2 * n - 1; ++k)
      EXPECT_NEAR(integral_of_power(rule, k), 1.0 / (k + 1), 100 * eps) << n << ' ' << k;
    if (n <= 6) {
      // Error for x^2n: (n!)^4 / ((2n + 1) (2n)!^2), e.g. 1/12 for n = 1; it must be there.
      const double factorials = std::tgamma(n + 1.0) * std::tgamma(n + 1.0) / std::tgamma(2.0 * n + 1.0);
      EXPECT_NEAR(1.0 / (2 * n + 1) - integral_of_power(rule, 2 * n), factorials * factorials / (2 * n + 1),
                  100 * eps);
    }
  }
}

TEST(GaussLegendre, HasIncreasingSymmetricNodesAndPositiveWeights) {
  for (int n = 1; n <= 64; ++n) {
    const QuadratureRule& rule = gauss_legendre(n);
    for (std::size_t i = 0; i < rule.x.size(); ++i) {
      EXPECT_GT(rule.w[i], 0.0);
      EXPECT_GT(rule.x[i], i == 0 ? 0.0 : rule.x[i - 1]);
      EXPECT_NEAR(rule.x[i] + rule.x[rule.x.size() - 1 - i], 1.0, eps);
    }
  }
}

TEST(GaussLegendre, RefusesSizesOutsideItsRange) {
  EXPECT_THROW((void)gauss_legendre(0), InputError);
  EXPECT_THROW((void)gauss_legendre(65), InputError);
}

}  // namespace
}  // namespace blendwright
