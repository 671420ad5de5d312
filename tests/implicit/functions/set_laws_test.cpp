// What R-functions and Ricci's operators of level function must be, from their definitions.
#include <gtest/gtest.h>

#include <cmath>

#include "implicit/operators/function_r.hpp"
#include "implicit/primitives/quadric.hpp"
#include "tests/implicit/functions/argument_tape.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

double any_alpha(Rng& rng) { return integer(rng, 0, 3) == 0 ? 0.0 : uniform(rng, -0.99, 0.999); }
double any_field(Rng& rng) { return uniform(rng, -1.0, 1.0) * log_uniform(rng, 1e-3, 1e3); }

/// On the boundary, where the other operand does not decide, f' = f_i'.
TEST(RFunction, HasTheGradientOfTheChildOnTheBoundary) {
  for_all([](Rng& rng) {
    const double alpha = any_alpha(rng), other = log_uniform(rng, 1e-6, 1e6);
    for (const Join join : joins) {
      // Positive in the others' signs for an intersection, negative for a union.
      const double f2 = join == Join::intersect ? other : -other;
      const Partials at = partials(r_alpha(alpha, join), {0.0, f2});
      EXPECT_EQ(at.value, 0.0);
      // A few roundings, divided by 1 + alpha >= 0.01.
      EXPECT_NEAR(at.partials[0], 1.0, 1e-13);
      EXPECT_NEAR(at.partials[1], 0.0, 1e-13);
    }
    const Partials swapped = partials(r_alpha(alpha, Join::intersect), {other, 0.0});
    EXPECT_NEAR(swapped.partials[1], 1.0, 1e-13);
  });
}

/// Neither sum nor root of the definition keeps digits where they cancel; the definition in long double does.
TEST(RFunction, KeepsAllDigitsWhereItsTermsCancel) {
  for_all(
      [](Rng& rng) {
        const double alpha = any_alpha(rng);
        const double a = log_uniform(rng, 1e-6, 1e6), b = a * log_uniform(rng, 1e-4, 1e4);
        const long double x = a, y = b;
        const long double s = std::sqrt((x - y) * (x - y) + 2.0L * (1.0L - alpha) * x * y);
        const long double exact = 2.0L * x * y / (x + y + s);
        EXPECT_NEAR(value(r_alpha(alpha, Join::intersect), {a, b}) / static_cast<double>(exact), 1.0, 2e-15);
        EXPECT_NEAR(value(r_alpha(alpha, Join::unite), {-a, -b}) / static_cast<double>(exact), -1.0, 2e-15);
      },
      2000);
}

TEST(RFunction, IsBelowMinAndHasItsSign) {
  for_all(
      [](Rng& rng) {
        const double alpha = any_alpha(rng), f1 = any_field(rng), f2 = any_field(rng);
        const double least = std::min(f1, f2), most = std::max(f1, f2),
                     slack = 1e-13 * (1.0 + std::abs(most));
        const double both = value(r_alpha(alpha, Join::intersect), {f1, f2});
        const double any = value(r_alpha(alpha, Join::unite), {f1, f2});
        EXPECT_LE(both, least + slack * std::abs(least));
        EXPECT_GE(any, most - slack * std::abs(most));
        EXPECT_EQ(both >= 0.0, least >= 0.0);
        EXPECT_EQ(any >= 0.0, most >= 0.0);
        EXPECT_EQ(any, -value(r_alpha(alpha, Join::intersect), {-f1, -f2}));
        EXPECT_EQ(value(r_alpha(alpha, Join::subtract), {f1, f2}),
                  value(r_alpha(alpha, Join::intersect), {f1, -f2}));
      },
      2000);
}

/// 0 <= min - I = d sqrt((1 - alpha)/2) at most, d the larger: at f1 = f2 = d it is d (1 - 2/(2 + e)), e =
/// sqrt(2 - 2 alpha), and homogeneous; for f1 != f2 less than (s - |f1 - f2|)/(1 + alpha) <= e sqrt(f1 f2)/2.
TEST(RFunction, TendsToMinAndMax) {
  for_all([](Rng& rng) {
    const double less = log_uniform(rng, 1e-14, 1e-2), alpha = 1.0 - less;
    const double f1 = log_uniform(rng, 0.1, 10.0), f2 = log_uniform(rng, 0.1, 10.0);
    const double gap = std::min(f1, f2) - value(r_alpha(alpha, Join::intersect), {f1, f2});
    EXPECT_GE(gap, -1e-13);
    EXPECT_LE(gap, 0.6 * std::sqrt(2.0 * less) * std::sqrt(f1 * f2) + 0.5 * less * std::max(f1, f2) + 1e-13);
    EXPECT_EQ(value(r_alpha(1.0, Join::intersect), {f1, f2}), std::min(f1, f2));
    EXPECT_EQ(value(r_alpha(1.0, Join::unite), {f1, f2}), std::max(f1, f2));
    EXPECT_EQ(value(r_alpha(1.0, Join::subtract), {f1, f2}), std::min(f1, -f2));
  });
}

TEST(RFunction, HasTheLimitOfItsGradientWhereBothAreZero) {
  for (const double alpha : {-0.5, 0.0, 0.7}) {
    const Partials at = partials(r_alpha(alpha, Join::intersect), {0.0, 0.0});
    const Partials near = partials(r_alpha(alpha, Join::intersect), {1e-9, 1e-9});
    EXPECT_EQ(at.value, 0.0);
    for (const std::size_t i : {0u, 1u}) {
      EXPECT_NEAR(at.partials[i], 1.0 / (2.0 + std::sqrt(2.0 - 2.0 * alpha)), 1e-15);
      EXPECT_NEAR(at.partials[i], near.partials[i], 1e-14);
    }
  }
}

TEST(RFunction, TakesInfiniteOperands) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {-2.0, 0.0, 3.0}) {
    EXPECT_EQ(value(r_alpha(0.0, Join::intersect), {x, infinity}), x);
    EXPECT_EQ(value(r_alpha(0.0, Join::unite), {-infinity, x}), x);
    EXPECT_EQ(value(r_alpha(0.3, Join::intersect), {x, -infinity}), -infinity);
    EXPECT_EQ(partials(r_alpha(0.0, Join::intersect), {x, infinity}).partials, (std::vector{1.0, 0.0}));
  }
}

/// R(l f) = l^(m+1) R(f), l > 0: powers of two, so that nothing rounds. Hence C^m at 0, and not C^(m+1): the
/// third-order term of m = 2 keeps its size on the way to 0 and depends on the direction.
TEST(RFunctionM, IsHomogeneousOfDegreeMPlusOne) {
  for_all([](Rng& rng) {
    const int m = integer(rng, 1, 6), k = integer(rng, -6, 6);
    const double f1 = uniform(rng, -2.0, 2.0), f2 = uniform(rng, -2.0, 2.0), l = std::ldexp(1.0, k);
    for (const Join join : joins) {
      const double whole = value(r_m(m, join), {f1, f2}), part = value(r_m(m, join), {l * f1, l * f2});
      EXPECT_NEAR(part, std::ldexp(whole, k * (m + 1)), 1e-14 * std::abs(part));
      EXPECT_EQ(whole > 0.0, value(r_alpha(0.0, join), {f1, f2}) > 0.0);
    }
  });
}
TEST(RFunctionM, IsRZeroTimesAPower) {
  for_all([](Rng& rng) {
    const int m = integer(rng, 1, 6);
    const double f1 = uniform(rng, -2.0, 2.0), f2 = uniform(rng, -2.0, 2.0);
    for (const Join join : joins) {
      const double plain = value(r_alpha(0.0, join), {f1, f2}), power = std::pow(std::hypot(f1, f2), m);
      EXPECT_NEAR(value(r_m(m, join), {f1, f2}), plain * power, 1e-14 * std::abs(plain * power));
    }
  });
}
/// The second derivatives of m = 1 and m = 2 along a line to the edge: bounded and jumping, and to 0.
TEST(RFunctionM, IsAsSmoothAtTheEdgeAsItsName) {
  const auto second = [](int m, double scale, double angle) {
    const auto tape = combination_tape(r_m(m, Join::intersect), 2);
    const Vec3 p(scale * std::cos(angle), scale * std::sin(angle), 0.0);
    double out[10];
    tape->evaluate(Order::hessian, {{&p.x(), 1}, {&p.y(), 1}, {&p.z(), 1}}, out);
    return out[4];
  };
  EXPECT_NEAR(second(1, 1e-8, 0.3), second(1, 1e-2, 0.3), 1e-12);
  EXPECT_GT(std::abs(second(1, 1e-8, 0.3) - second(1, 1e-8, 2.0)), 0.1);
  EXPECT_NEAR(second(2, 1e-8, 0.3), 1e-6 * second(2, 1e-2, 0.3), 1e-16);
}

/// ln k/n is the exact distance of log-sum-exp from max at equal operands, and the largest one.
TEST(RicciFunction, IsWithinItsDistanceOfMinAndMax) {
  for_all([](Rng& rng) {
    const std::size_t k = 2 + rng.next() % 3;
    const double n = log_uniform(rng, 0.5, 1e6), gap = std::log(static_cast<double>(k)) / n;
    std::vector<double> f;
    for (std::size_t i = 0; i < k; ++i) f.push_back(uniform(rng, -2.0, 2.0));
    const double most = *std::max_element(f.begin(), f.end()), least = *std::min_element(f.begin(), f.end());
    const double any = value(ricci(n, Join::unite), f), all = value(ricci(n, Join::intersect), f);
    EXPECT_GE(any, most - 1e-14);
    EXPECT_LE(any, most + gap + 1e-14);
    EXPECT_LE(all, least + 1e-14);
    EXPECT_GE(all, least - gap - 1e-14);
    std::vector<double> turned = f;
    for (std::size_t i = 1; i < k; ++i) turned[i] = -f[i];
    EXPECT_NEAR(value(ricci(n, Join::subtract), f), value(ricci(n, Join::intersect), turned), 1e-14);
    double sum = 0.0;
    for (const double p : partials(ricci(n, Join::unite), f).partials) sum += p;
    EXPECT_NEAR(sum, 1.0, 1e-13);
    const std::vector<double> same(k, 0.7);
    EXPECT_NEAR(value(ricci(n, Join::unite), same), 0.7 + gap, 1e-14 + 1e-15 * gap);
  });
}

/// Where one operand decides, its derivatives are the result's, however steep it is: x^2 times 1e9 against 0.
TEST(RicciFunction, KeepsTheDerivativesOfTheOperandThatDecides) {
  const Combination of_square = [combine = ricci(2.0, Join::unite)](TapeBuilder& tape,
                                                                    std::span<const StepIndex> args) {
    const auto square = std::make_shared<const detail::Perturbation>(detail::Perturbation{1e9, 2, 0.0});
    const StepIndex both[] = {tape.add(square, Frame(), {args[0]}), tape.constant(0.0)};
    return combine(tape, both);
  };
  const auto tape = combination_tape(of_square, 1);
  const double x[] = {3.0}, y[] = {0.0};
  double out[10];
  tape->evaluate(Order::hessian, {x, y, y}, out);
  EXPECT_EQ(out[0], 9e9);
  EXPECT_EQ(out[1], 6e9);
  EXPECT_EQ(out[4], 2e9);
}

}  // namespace
}  // namespace blendwright::test
