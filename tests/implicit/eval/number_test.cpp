// Functions of numbers: values and derivatives are right, and alike for scalars and the vectors of every
// instruction set of this machine.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "implicit/primitives/lp_metric.hpp"
#include "tests/implicit/eval/number_functions.hpp"
#include "tests/implicit/support/evaluator_suite.hpp"

namespace blendwright::test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double least_normal = std::numeric_limits<double>::min();
constexpr double largest = std::numeric_limits<double>::max();

/// Runs `check(vectors)` for scalars and for each instruction set.
template <class Check>
void for_all_lanes(Check check) {
  {
    SCOPED_TRACE("scalar");
    check(false);
  }
  for (const std::string& set : instruction_sets()) {
    SCOPED_TRACE(set);
    choose_instruction_set(set);
    check(true);
  }
  choose_instruction_set("");
}

struct Samples {
  std::vector<double> p, q;
  Samples(const NumberFunction& f, std::uint64_t seed, std::size_t count) {
    Rng rng(seed);
    for (std::size_t i = 0; i < count; ++i) {
      p.push_back(uniform(rng, f.p_lo, f.p_hi));
      q.push_back(uniform(rng, f.q_lo, f.q_hi));
    }
  }
};

TEST(Numbers, EveryInstructionSetIsTried) { EXPECT_GE(instruction_sets().size(), 1u); }

// Both round each operation once, the vectors fewer times where they fuse; lane functions have at most 4 ulp.
// The arguments a and b differ by at most 2 ulp, which the gradient turns into errors of f. Norms and powers
// are made of up to a dozen operations.
TEST(Numbers, VectorsAgreeWithScalars) {
  for_all_lanes([](bool vectors) {
    for (std::size_t k = 0; k < number_functions().size(); ++k) {
      SCOPED_TRACE(number_functions()[k].name);
      const Samples s(number_functions()[k], 1, 1000);
      const auto exact = run_function(k, 2, false, s.p, s.q), got = run_function(k, 2, vectors, s.p, s.q);
      const std::size_t n = s.p.size();
      for (std::size_t i = 0; i < n; ++i) {
        const double reach = 3.0 * (std::abs(exact[n + i]) + std::abs(exact[2 * n + i]));
        ASSERT_NEAR(got[i], exact[i], epsilon * (16.0 * std::abs(exact[i]) + 2.0 * reach))
            << s.p[i] << " " << s.q[i];
      }
    }
  });
}

TEST(Numbers, ValuesAndGradientsDoNotDependOnTheOrder) {
  for_all_lanes([](bool vectors) {
    for (std::size_t k = 0; k < number_functions().size(); ++k) {
      SCOPED_TRACE(number_functions()[k].name);
      const Samples s(number_functions()[k], 2, 100);
      const auto two = run_function(k, 2, vectors, s.p, s.q);
      for (int order : {0, 1}) {
        const auto less = run_function(k, order, vectors, s.p, s.q);
        EXPECT_EQ(less,
                  std::vector<double>(two.begin(), two.begin() + static_cast<std::ptrdiff_t>(less.size())));
      }
    }
  });
}

/// Component c of function k at the points of a stencil around (p, q) along one axis.
suite::Difference difference_of(std::size_t k, bool vectors, double p, double q, int axis, std::size_t c) {
  constexpr double h = 1e-3;
  std::vector<double> x, y;
  for (const double o : {-h, -0.5 * h, 0.0, 0.5 * h, h}) {
    x.push_back(axis == 0 ? p + o : p);
    y.push_back(axis == 1 ? q + o : q);
  }
  const auto f = run_function(k, 1, vectors, x, y);
  double around[5], size = 1.0;
  for (std::size_t i = 0; i < 5; ++i) {
    around[i] = f[c * 5 + i];
    size = std::max(size, std::abs(around[i]));
  }
  return suite::difference(around, h, 64.0 * epsilon * size);
}

TEST(Numbers, DerivativesAreThoseOfDifferences) {
  for_all_lanes([](bool vectors) {
    for (std::size_t k = 0; k < number_functions().size(); ++k) {
      SCOPED_TRACE(number_functions()[k].name);
      const Samples s(number_functions()[k], 3, 60);
      const auto f = run_function(k, 2, vectors, s.p, s.q);
      const std::size_t n = s.p.size();
      int useful = 0, all = 0;
      for (std::size_t i = 0; i < n; ++i)
        for (int axis : {0, 1})
          for (std::size_t c = 0; c < 3; ++c) {
            const auto a = static_cast<std::size_t>(axis);
            const double claimed = f[(c == 0 ? 1 + a : suite::hessian_component(a, c - 1)) * n + i];
            const auto d = difference_of(k, vectors, s.p[i], s.q[i], axis, c);
            ++all;
            if (d.error < 1e-2 * (1.0 + std::abs(d.estimate))) ++useful;
            ASSERT_NEAR(claimed, d.estimate, d.error)
                << "axis " << axis << " component " << c << " at " << s.p[i] << " " << s.q[i];
          }
      EXPECT_GT(useful, 0.9 * all);
      for (std::size_t i = 0; i < n; ++i)
        for (const std::size_t c : {3, 6, 8, 9}) EXPECT_EQ(f[c * n + i], 0.0) << "nothing depends on z";
    }
  });
}

TEST(Numbers, SignsMinimaAndChoicesKeepTheirConventions) {
  for_all_lanes([](bool vectors) {
    const std::vector<double> x{-0.0, 0.0, 1e-320, -1e-320, 3.0, -infinity, 2.0, 5.0};
    const std::vector<double> y{0.0, -0.0, 0.0, 0.0, 3.0, 1.0, 7.0, -infinity};
    EXPECT_EQ(run_lanes("sign", vectors, x, y), (std::vector<double>{0, 0, 1, -1, 1, -1, 1, 1}));
    EXPECT_EQ(run_lanes("select", vectors, x, y), (std::vector<double>{2, 2, 2, 1, 2, 1, 1, 2}));
    const auto low = run_lanes("min", vectors, x, y), high = run_lanes("max", vectors, x, y);
    EXPECT_EQ(low, (std::vector<double>{0, 0, 0, -1e-320, 3, -infinity, 2, -infinity}));
    EXPECT_EQ(high, (std::vector<double>{0, 0, 1e-320, 0, 3, 1, 7, 5}));
    EXPECT_TRUE(std::signbit(low[0]) && std::signbit(high[0])) << "the first argument on ties";
    EXPECT_FALSE(std::signbit(low[1]) || std::signbit(high[1]));
  });
  for_all_lanes([](bool vectors) {
    for (const double all : {0.0, 3.0})
      for (const double v :
           run_lanes("any_all", vectors, std::vector<double>(8, 1.0 - all), std::vector<double>(8, 0.0)))
        EXPECT_EQ(v, all);
  });
}

// The quotient is rounded once, the arc tangent has 4 ulp and the reflections add one rounding of at most pi:
// 8 ulp of pi.
TEST(Numbers, AnglesAreThoseOfAtan2) {
  std::vector<double> x{0.0, 1.0, -1.0, 0.0, 0.0, 1e-300, -1e300, 1.0, -1.0, 2.0, -2.0},
      y{0.0, 0.0, 0.0, 1.0, -1.0, 1e-300, 1e300, 1e-300, 1e-300, -2.0, -2.0};
  Rng rng(4);
  for (int i = 0; i < 1000; ++i) {
    x.push_back(log_uniform(rng, 1e-3, 1e3) * (i % 2 ? 1 : -1));
    y.push_back(log_uniform(rng, 1e-3, 1e3) * (i % 4 < 2 ? 1 : -1));
  }
  for_all_lanes([&](bool vectors) {
    const auto angle = run_lanes("atan2", vectors, y, x);
    EXPECT_EQ(angle[0], 0.0) << "the origin";
    for (std::size_t i = 1; i < x.size(); ++i)
      EXPECT_NEAR(angle[i], std::atan2(y[i], x[i]), 8.0 * epsilon * 3.15) << x[i] << " " << y[i];
  });
}

TEST(Power, KnowsTheCheapestWay) {
  using Kind = detail::Power::Kind;
  EXPECT_EQ(detail::Power(20.0).kind, Kind::integer);
  EXPECT_EQ(detail::Power(64.0).kind, Kind::integer);
  EXPECT_EQ(detail::Power(65.0).kind, Kind::real);
  EXPECT_EQ(detail::Power(0.5).kind, Kind::square_root);
  EXPECT_EQ(detail::Power(1.5).kind, Kind::real);
}

/// x over the whole range of doubles, and close to 1, where the logarithm is small.
std::vector<double> bases(std::size_t count) {
  std::vector<double> x{1.0,
                        0.0,
                        1e-320,
                        least_normal,
                        2.0,
                        0.5,
                        largest,
                        infinity,
                        std::nextafter(1.0, 0.0),
                        std::nextafter(1.0, 2.0),
                        std::sqrt(0.5),
                        std::sqrt(2.0)};
  Rng rng(5);
  while (x.size() < count) {
    x.push_back(log_uniform(rng, 1e-323, largest));
    x.push_back(log_uniform(rng, 0.5, 2.0));
    x.push_back(1.0 + uniform(rng, -1e-6, 1e-6));
    x.push_back(uniform(rng, 0.0, 1.0));
  }
  return x;
}

// The bound is derived at lane_power: 1e-15 (1 + |n ln x|). Where a vector unit cannot fuse, three more
// roundings enter the logarithm and as many the exponential: 2e-15 in place of 1e-15 holds for all.
TEST(Power, IsAsCloseToTheLongDoublePowerAsItSays) {
  for (const double exponent : {1.1, 0.05, 1.0 / 3.0, 0.6, 2.5, 19.7, 300.3}) {
    SCOPED_TRACE(exponent);
    const detail::Power n(exponent);
    const std::vector<double> x = bases(1000000 / 7);
    std::vector<long double> exact;
    for (const double b : x)
      exact.push_back(std::pow(static_cast<long double>(b), static_cast<long double>(exponent)));
    for_all_lanes([&](bool vectors) {
      const auto got = run_power(n, vectors, x);
      EXPECT_EQ(got[0], 1.0);
      double worst = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        if (x[i] < n.floor) {
          EXPECT_EQ(got[i], 0.0) << x[i];
        } else if (x[i] > n.ceiling) {
          EXPECT_EQ(got[i], infinity) << x[i];
        } else {
          const double error =
              std::abs(static_cast<double>((static_cast<long double>(got[i]) - exact[i]) / exact[i]));
          worst = std::max(worst, error / (1.0 + std::abs(exponent * std::log(x[i]))));
        }
      }
      EXPECT_LT(worst, 2e-15);
    });
  }
}

TEST(Power, CountsAsZeroOnlyWhatIsNextToNothing) {
  for (const double exponent : {0.05, 0.6, 1.1, 20.5}) {
    const detail::Power n(exponent);
    EXPECT_LE(n.floor, std::max(least_normal, std::exp2(-1019.0 / exponent)));
    EXPECT_GE(n.ceiling, std::min(largest, std::exp2(1022.0 / exponent)));
  }
}

struct NormCase {
  double n;
  double x, y, z;
};

// m (1 + ...)^(1/n): the terms r^n have errors of n ulp from r, at most 64 n; the root divides them by n, and
// adds 1e-15 (1 + ln 3 / n).
TEST(Norm, NeitherOverflowsNorVanishes) {
  const double sizes[] = {1e300, 1e-300, 1e-20, 1.0, 7e307};
  for_all_lanes([&](bool vectors) {
    for (const double n : {0.6, 1.0, 1.1, 2.0, 3.0, 20.0, 77.7}) {
      std::vector<double> x, y, z;
      std::vector<long double> exact;
      for (const double s : sizes)
        for (int k = 1; k < 27; ++k) {
          const double t[3] = {0.25 * (k % 3), 0.5 * (k / 3 % 3), 0.125 * (k / 9)};
          x.push_back(s * t[0]);
          y.push_back(-s * t[1]);
          z.push_back(s * t[2]);
          long double sum = 0.0L;
          for (const double u : t) sum += std::pow(static_cast<long double>(u), static_cast<long double>(n));
          exact.push_back(std::pow(sum, 1.0L / static_cast<long double>(n)) * static_cast<long double>(s));
        }
      const auto got = run_norm(detail::Power(n), detail::Power(1.0 / n), vectors, x, y, z);
      for (std::size_t i = 0; i < x.size(); ++i) {
        const auto e = static_cast<double>(exact[i]);
        if (std::isinf(e)) continue;
        EXPECT_NEAR(got[i], e, 1e-14 * (1.0 + 1.0 / n) * e)
            << n << ": " << x[i] << " " << y[i] << " " << z[i];
      }
      for (std::size_t c = 1; c < 10; ++c)
        for (std::size_t i = 0; i < x.size(); ++i)
          EXPECT_TRUE(std::isfinite(got[c * x.size() + i]))
              << c << " of " << n << ": " << x[i] << " " << y[i];
    }
  });
}

TEST(Norm, OfZerosAndInfinitiesHasNoNaN) {
  const double special[] = {0.0, -0.0, 1e-320, 1e-170, 1e-80, 1.0, largest, infinity, -infinity};
  std::vector<double> x, y, z;
  for (const double a : special)
    for (const double b : special)
      for (const double c : special) {
        x.push_back(a);
        y.push_back(b);
        z.push_back(c);
      }
  for_all_lanes([&](bool vectors) {
    for (const double n : {0.3, 0.6, 1.0, 1.1, 2.0, 20.0}) {
      const auto got = run_norm(detail::Power(n), detail::Power(1.0 / n), vectors, x, y, z);
      for (std::size_t i = 0; i < x.size(); ++i) {
        const double m = std::max({std::abs(x[i]), std::abs(y[i]), std::abs(z[i])});
        EXPECT_GE(got[i], m * (1.0 - 4.0 * epsilon));
        if (m == 0.0) {
          EXPECT_EQ(got[i], 0.0);
        }
        for (std::size_t c = 1; c < 10; ++c)
          EXPECT_TRUE(std::isfinite(got[c * x.size() + i]))
              << n << " component " << c << ": " << x[i] << " " << y[i] << " " << z[i];
      }
    }
  });
}

// In a coordinate plane the second derivatives of N_2 are those of |X|, though |x| has a kink there.
TEST(Norm, OfTwoIsSmoothInTheCoordinatePlanes) {
  for_all_lanes([](bool vectors) {
    const auto got = run_norm(detail::Power(2.0), detail::Power(0.5), vectors, {0.0}, {3.0}, {4.0});
    EXPECT_NEAR(got[0], 5.0, 1e-15);
    EXPECT_NEAR(got[4], 1.0 / 5.0, 1e-15);
    EXPECT_NEAR(got[5], 16.0 / 125.0, 1e-15);
    EXPECT_NEAR(got[9], -12.0 / 125.0, 1e-15);
  });
}

TEST(LpMetric, IsExactOnTheAxis) {
  detail::LpMetric body;
  body.inverse_axes = Vec3(0.125, 0.125, 0.0625);
  body.n = detail::Power(20.0);
  body.inverse_n = detail::Power(1.0 / 20.0);
  EXPECT_EQ(scalar_value(op_for<detail::LpMetric>(), &body, Vec3(4, 0, 0)), 0.5);
}

}  // namespace
}  // namespace blendwright::test
