#include "kernel/math/taylor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::Rng;
using test::uniform;
using S4 = Taylor<4>;
using S2 = Taylor2<2>;
using S24 = Taylor2<4>;

struct Function {
  std::string name;
  double lo, hi;  ///< stays 0.5 away from singularities
  std::function<double(double)> on_number;
  std::function<S4(const S4&)> on_series;
};

#define FUNCTION(text, lo, hi, body)                                                              \
  Function {                                                                                      \
    text, lo, hi, [](double x) -> double { return body; }, [](const S4& x) -> S4 { return body; } \
  }

std::vector<Function> functions() {
  using std::sin, std::cos, std::tan, std::asin, std::acos, std::atan, std::atan2, std::sinh, std::cosh,
      std::tanh, std::exp, std::log, std::sqrt, std::abs, std::pow;
  return {FUNCTION("sin", -3, 3, sin(x)),
          FUNCTION("cos", -3, 3, cos(x)),
          FUNCTION("tan", -1, 1, tan(x)),
          FUNCTION("asin", -0.5, 0.5, asin(x)),
          FUNCTION("acos", -0.5, 0.5, acos(x)),
          FUNCTION("atan", -3, 3, atan(x)),
          FUNCTION("atan2 with falling x", 0.5, 3, atan2(x, 1.0 - x)),
          FUNCTION("atan2 across the branch of the angle pi", -3, -0.5, atan2(0.1 * (x * x), x)),
          FUNCTION("sinh", -2, 2, sinh(x)),
          FUNCTION("cosh", -2, 2, cosh(x)),
          FUNCTION("tanh", -2, 2, tanh(x)),
          FUNCTION("exp", -2, 2, exp(x)),
          FUNCTION("log", 0.5, 3, log(x)),
          FUNCTION("sqrt", 0.5, 3, sqrt(x)),
          FUNCTION("abs of a negative", -3, -0.5, abs(x)),
          FUNCTION("whole power", -2, 2, pow(x, 5.0)),
          FUNCTION("negative whole power of a negative", -3, -0.5, pow(x, -2.0)),
          FUNCTION("real power", 0.5, 3, pow(x, -1.7)),
          FUNCTION("power of a power", 0.5, 3, pow(x, x)),
          FUNCTION("quotients", 0.5, 3, (1.0 - 2.0 / x) / (x + 1.0) / 3.0 - (-x)),
          FUNCTION("reciprocal", 0.5, 3, 1.0 / x)};
}
#undef FUNCTION

TEST(Taylor, DerivativesOfEveryFunctionAgreeWithDifferencesOfTheOrderBelow) {
  const double h = 1.8e-3;
  for (const Function& f : functions()) {
    SCOPED_TRACE(f.name);
    for_all(
        [&](Rng& rng) {
          const double x = uniform(rng, f.lo, f.hi);
          const S4 s = f.on_series(S4::variable(x));
          ASSERT_NEAR(s.value(), f.on_number(x),
                      1e-14 * (1.0 + std::abs(f.on_number(x))));  // a few roundings
          for (int k = 1; k <= 4; ++k) {
            const auto lower = [&](double t) {
              return k == 1 ? f.on_number(x + t) : f.on_series(S4::variable(x + t)).derivative(k - 1);
            };
            const double difference =
                (8 * (lower(h) - lower(-h)) - (lower(2 * h) - lower(-2 * h))) / (12 * h);
            // Truncation h^4 / 30 f^(k+4). The worst is x^-2 at |x| = 0.5: f^(8) / f^(4) = 2^4 9! / 5! = 48400,
            // times h^4 / 30 = 3.5e-13: 1.7e-8.
            double scale = 1.0;
            for (int m = 0; m <= 4; ++m) scale = std::max(scale, std::abs(s.derivative(m)));
            ASSERT_NEAR(s.derivative(k), difference, 2e-8 * scale) << "order " << k << " at x = " << x;
          }
        },
        50);
  }
}

TEST(Taylor, KnownSeriesAreExact) {
  const S4 x = S4::variable(0.0);
  const auto expect = [](const S4& s, std::array<double, 5> c) {
    for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(s.c[k], c[k], 1e-16) << k;
  };
  expect(exp(x), {1, 1, 0.5, 1.0 / 6, 1.0 / 24});
  expect(log(1.0 + x), {0, 1, -0.5, 1.0 / 3, -0.25});
  expect(sin(x), {0, 1, 0, -1.0 / 6, 0});
  expect(cos(x), {1, 0, -0.5, 0, 1.0 / 24});
  expect(tan(x), {0, 1, 0, 1.0 / 3, 0});
  expect(tanh(x), {0, 1, 0, -1.0 / 3, 0});
  expect(atan(x), {0, 1, 0, -1.0 / 3, 0});
  expect(asin(x), {0, 1, 0, 1.0 / 6, 0});
  expect(sqrt(1.0 + x), {1, 0.5, -0.125, 0.0625, -0.0390625});
  expect(1.0 / (1.0 - x), {1, 1, 1, 1, 1});
  expect(sin_cos(x)[0], sin(x).c);
  expect(sin_cos(x)[1], cos(x).c);
}

TEST(Taylor, WholePowersAreExactAtZeroAndOfNegativeNumbers) {
  for (int n = 0; n <= 6; ++n) {
    SCOPED_TRACE(n);
    const S4 at_zero = pow(S4::variable(0.0), static_cast<double>(n));
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(at_zero.c[k], static_cast<int>(k) == n ? 1.0 : 0.0) << k;
    const S4 negative = pow(S4::variable(-2.0), static_cast<double>(n));
    double binomial = 1.0;  // (-2 + h)^n
    for (int k = 0; k <= 4; ++k) {
      EXPECT_EQ(negative.c[static_cast<std::size_t>(k)], k > n ? 0.0 : binomial * std::pow(-2.0, n - k)) << k;
      binomial = binomial * (n - k) / (k + 1);
    }
  }
}

TEST(Taylor, PowersOfAConstantZeroHaveNoNaN) {
  EXPECT_EQ(sqrt(S24(0.0)).c, S24(0.0).c);
  EXPECT_EQ(pow(S24(0.0), 1.5).c, S24(0.0).c);
  EXPECT_EQ(pow(S24(0.0), S24(2.0)).c, S24(0.0).c);
  EXPECT_EQ(pow(S24(0.0), 0.0).c, S24(1.0).c);
}

TEST(Taylor, OnlyDerivativesThatAreInfiniteAreNotFinite) {
  const S2 s = pow(S2::u_variable(0.0), 1.5) * (1.0 + S2::v_variable(3.0));  // u^1.5 (1 + v)
  EXPECT_EQ(s.derivative(0, 0), 0.0);
  EXPECT_EQ(s.derivative(1, 0), 0.0);
  EXPECT_EQ(s.derivative(0, 1), 0.0);
  EXPECT_EQ(s.derivative(0, 2), 0.0);
  EXPECT_FALSE(std::isfinite(s.derivative(2, 0)));
}

TEST(Taylor, TanhKeepsItsRelativeAccuracyNearZeroAndFarOut) {
  EXPECT_DOUBLE_EQ(tanh(S4::variable(1e-10)).value(), std::tanh(1e-10));
  const double sech = 1.0 / std::cosh(15.0);
  EXPECT_DOUBLE_EQ(tanh(S4::variable(15.0)).derivative(1), sech * sech);
}

/// A random polynomial in the two variables, as series of both orders.
template <class T>
T random_series(Rng& rng, std::size_t coefficients) {
  T t;
  for (std::size_t k = 0; k < coefficients; ++k) t.c[k] = std::floor(uniform(rng, -9.0, 9.0));
  return t;
}

TEST(Taylor2, TheProductOfOrderTwoIsTheTruncatedProductOfOrderFour) {
  for_all([](Rng& rng) {
    const S24 a = random_series<S24>(rng, 15), b = random_series<S24>(rng, 15);
    S2 a2, b2;
    for (std::size_t k = 0; k < 6; ++k) {
      a2.c[k] = a.c[k];
      b2.c[k] = b.c[k];
    }
    const S24 product = a * b;
    const S2 product2 = a2 * b2;
    for (std::size_t k = 0; k < 6; ++k) ASSERT_EQ(product.c[k], product2.c[k]);  // whole numbers: exact
    const S24 sparse = sparse_product(a, b);
    for (std::size_t k = 0; k < 15; ++k) ASSERT_EQ(product.c[k], sparse.c[k]);
  });
}

TEST(Taylor2, DerivativesOfAProductOfKnownFunctionsAreExact) {
  const double u = 0.4, v = -0.7;
  const S24 s = exp(2.0 * S24::u_variable(u)) * sin(3.0 * S24::v_variable(v));
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j) {
      const double turned =
          3.0 * v + j * 1.5707963267948966;  // d/dv of sin(3 v): a quarter turn and a factor 3
      const double expected = std::pow(2.0, i) * std::exp(2.0 * u) * std::pow(3.0, j) * std::sin(turned);
      EXPECT_NEAR(s.derivative(i, j), expected, 1e-13 * std::pow(3.0, i + j)) << i << ", " << j;
    }
}

TEST(Taylor, DifferentiatedLosesOneOrder) {
  const S4 s = exp(S4::variable(0.3)).differentiated();
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(s.derivative(k), std::exp(0.3), 1e-14);
  EXPECT_EQ(s.c[4], 0.0);
}

}  // namespace
}  // namespace blendwright
