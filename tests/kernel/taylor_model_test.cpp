#include "kernel/math/taylor_model.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "kernel/math/model_jet.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::Rng;
using test::uniform;
using Long = long double;

struct Function {
  std::string name;
  double lo, hi;
  std::function<Long(Long)> exact;
  std::function<TaylorModel(const TaylorModel&)> model;
  std::function<ModelJet(const ModelJet&)> jet;
};

#define FUNCTION(text, lo, hi, body)                              \
  Function {                                                      \
    text, lo, hi, [](Long x) -> Long { return body; },            \
        [](const TaylorModel& x) -> TaylorModel { return body; }, \
        [](const ModelJet& x) -> ModelJet { return body; }        \
  }

std::vector<Function> functions() {
  using std::sin, std::cos, std::sinh, std::cosh, std::exp, std::log, std::sqrt, std::pow, std::atan2;
  return {FUNCTION("sin", -3, 3, sin(x)),
          FUNCTION("cos", -3, 3, cos(x)),
          FUNCTION("sinh", -2, 2, sinh(x)),
          FUNCTION("cosh", -2, 2, cosh(x)),
          FUNCTION("exp", -2, 2, exp(x)),
          FUNCTION("log", 0.5, 3, log(x)),
          FUNCTION("sqrt", 0.5, 3, sqrt(x)),
          FUNCTION("power", 0.5, 3, pow(x, -1.75)),
          FUNCTION("quotient", 0.5, 3, x / (x * x + x)),
          FUNCTION("angle", 0.5, 3, atan2(x, x * x - 2.0 * x)),
          FUNCTION("angle through the second quadrant", -3, -0.5, atan2(0.125 * (x * x), x)),
          FUNCTION("composition", -1, 1, sin(3.0 * cos(x)) * exp(-(x * x)) - x)};
}
#undef FUNCTION

struct Piece {
  double lo, hi;
};
Piece random_piece(Rng& rng, const Function& f, double width) {
  const double at = uniform(rng, f.lo, f.hi - width);
  return {at, at + width};
}
bool inside(const Bounds& b, Long x) { return static_cast<Long>(b.lo) <= x && x <= static_cast<Long>(b.hi); }

/// The exact argument that belongs to x, and x as a double: v = middle + half x in extended precision.
Long argument(const TaylorModel& v, double x) {
  return static_cast<Long>(v.coefficient(0)) + static_cast<Long>(v.coefficient(1)) * static_cast<Long>(x);
}

TEST(TaylorModel, EnclosesEveryFunctionBetweenTheSamples) {
  int outside_without_radius = 0;
  for (const Function& f : functions())
    for_all([&](Rng& rng) {
      SCOPED_TRACE(f.name);
      const Piece p = random_piece(rng, f, std::exp(uniform(rng, std::log(1e-6), std::log(0.25))));
      const TaylorModel v = TaylorModel::parameter(p.lo, p.hi), y = f.model(v);
      ASSERT_TRUE(y.finite());
      for (int k = 0; k < 10; ++k) {
        const double x = uniform(rng, -1.0, 1.0);
        const Long exact = f.exact(argument(v, x));
        EXPECT_TRUE(inside(y.at(x), exact)) << "at " << x;
        EXPECT_TRUE(inside(y.range(), exact));
        // The control: it is the radius that contains the roundings, the polynomial alone does not.
        outside_without_radius +=
            std::abs(static_cast<double>(exact) - y.with_radius(0.0).at(x).middle()) > 0 ? 1 : 0;
      }
    });
  EXPECT_GT(outside_without_radius, 1000);
}

TEST(TaylorModel, GrowsTightAsThePieceShrinks) {
  // The radius is of order 9 in the width of the piece, above rounding: a factor 2^8 at least per halving
  // while it is 1e-10 or more.
  for (const Function& f : functions()) {
    SCOPED_TRACE(f.name);
    const double at = 0.5 * (f.lo + f.hi) + 0.3;
    const double wide = f.model(TaylorModel::parameter(at - 0.2, at + 0.2)).radius();
    const double half = f.model(TaylorModel::parameter(at - 0.1, at + 0.1)).radius();
    if (wide > 1e-10) {
      EXPECT_LT(half, wide / 200.0);
    }
    EXPECT_LT(f.model(TaylorModel::parameter(at - 1e-3, at + 1e-3)).radius(), 1e-13);
  }
}

TEST(TaylorModel, IsUnboundedWhereAFunctionIsNotDefined) {
  const TaylorModel x = TaylorModel::parameter(-0.5, 1.0);
  EXPECT_FALSE(inverse(x).finite());
  EXPECT_FALSE(log(x).finite());
  EXPECT_FALSE(sqrt(x).finite());
  EXPECT_FALSE(atan2(x, TaylorModel(-1.0)).finite());
  EXPECT_TRUE(atan2(x, TaylorModel(1.0)).finite());
  EXPECT_FALSE((TaylorModel::unknown() + x).finite());
  EXPECT_FALSE((0.0 * TaylorModel::unknown()).finite());
}

TEST(TaylorModel, OfTheParameterReachesBothEnds) {
  for_all([](Rng& rng) {
    const double lo = uniform(rng, -10.0, 10.0), hi = lo + uniform(rng, 1e-12, 5.0);
    const TaylorModel v = TaylorModel::parameter(lo, hi);
    EXPECT_EQ(v.radius(), 0.0);
    EXPECT_LE(argument(v, -1.0), static_cast<Long>(lo));
    EXPECT_GE(argument(v, 1.0), static_cast<Long>(hi));
  });
}

TEST(TaylorModel, HullContainsBoth) {
  for_all([](Rng& rng) {
    const TaylorModel v = TaylorModel::parameter(0.0, 1.0);
    const TaylorModel a = sin(uniform(rng, -2.0, 2.0) * v), b = exp(uniform(rng, -1.0, 1.0) * v);
    const TaylorModel both = TaylorModel::hull(a, b);
    const double x = uniform(rng, -1.0, 1.0);
    for (const TaylorModel* m : {&a, &b}) {
      EXPECT_LE(both.at(x).lo, m->at(x).lo);
      EXPECT_GE(both.at(x).hi, m->at(x).hi);
    }
  });
}

TEST(ModelJet, EnclosesDerivativesOfEveryFunction) {
  // Central differences of the exact function with step d: truncation d^2 |f^(4)|/12 and rounding 4 2^-64
  // |f|/d^2. d = 2^-13 balances them near 1e-8 of scales below 100; 1e-5 is demanded.
  constexpr double tolerance = 1e-5, d = 0x1p-13;
  for (const Function& f : functions())
    for_all(
        [&](Rng& rng) {
          SCOPED_TRACE(f.name);
          const Piece p = random_piece(rng, f, 0.01);
          const TaylorModel v = TaylorModel::parameter(p.lo, p.hi);
          const ModelJet y = f.jet(ModelJet::u_variable(v));
          const double x = uniform(rng, -1.0, 1.0);
          const Long t = argument(v, x), h = d;
          EXPECT_TRUE(inside(y.c[0].at(x), f.exact(t)));
          const double first = static_cast<double>((f.exact(t + h) - f.exact(t - h)) / (2 * h));
          const double second =
              static_cast<double>((f.exact(t + h) - 2 * f.exact(t) + f.exact(t - h)) / (h * h));
          EXPECT_NEAR(y.c[1].at(x).middle(), first, tolerance * (1.0 + std::abs(first)));
          EXPECT_NEAR(2.0 * y.c[3].at(x).middle(), second, tolerance * (1.0 + std::abs(second)));
          EXPECT_LT(y.c[3].radius(), 1e-10);
          EXPECT_TRUE(y.c[2].is_zero());
        },
        50);
}

TEST(ModelJet, OfAClosedRangeComesBackByWholePeriods) {
  const double lo = -1.0, hi = 3.0;
  double turns = 0.0;
  const TaylorModel inner = inside_range(TaylorModel::parameter(8.0, 8.5), lo, hi, true, &turns);
  EXPECT_EQ(turns, 2.0);
  EXPECT_NEAR(inner.centre(), 0.25, 1e-12);
  EXPECT_FALSE(inside_range(TaylorModel::parameter(2.9, 3.2), lo, hi, true).finite());
  EXPECT_FALSE(inside_range(TaylorModel::parameter(2.9, 3.2), lo, hi, false).finite());
  EXPECT_TRUE(inside_range(TaylorModel::parameter(2.9, 3.0), lo, hi, true).finite());
  EXPECT_TRUE(inside_range(TaylorModel::parameter(3.0, 3.1), lo, hi, true).finite());
}

TEST(ModelJet, ChoosesABranchOnlyWhereItIsTheSameEverywhere) {
  const ModelJet x = ModelJet::u_variable(TaylorModel::parameter(-0.5, 0.5));
  EXPECT_FALSE(abs(x).c[0].finite());
  EXPECT_TRUE(abs(x + 1.0).c[0].finite());
  EXPECT_FALSE(min(x, ModelJet(0.0)).c[0].finite());
  EXPECT_EQ(max(x, ModelJet(2.0)).c[0].centre(), 2.0);
}

TEST(TaylorModel, MeanFromAPlaceContainsTheMean) {
  // Of a random polynomial of degree 8, whose mean has a closed form.
  for_all([](Rng& rng) {
    TaylorModel x = TaylorModel::parameter(-1.0, 1.0), f, power(1.0);
    std::array<double, 9> a{};
    for (double& c : a) c = uniform(rng, -1.0, 1.0);
    for (const double c : a) {
      f = f + c * power;
      power = power * x;
    }
    const double from = uniform(rng, -1.0, 1.0), to = uniform(rng, -1.0, 1.0);
    if (std::abs(to - from) < 1e-3) return;
    Long integral = 0.0L;
    for (std::size_t k = 0; k < a.size(); ++k) {
      const Long n = static_cast<Long>(k + 1);
      integral += static_cast<Long>(a[k]) / n *
                  (std::pow(static_cast<Long>(to), n) - std::pow(static_cast<Long>(from), n));
    }
    const Long mean = integral / (static_cast<Long>(to) - static_cast<Long>(from));
    const TaylorModel m = f.mean_from(Bounds(from));
    const Bounds b = m.at(to);
    EXPECT_LE(static_cast<Long>(b.lo) - 1e-15L, mean);  // long double over a step of 1e-3: 2^-64 9/1e-3
    EXPECT_GE(static_cast<Long>(b.hi) + 1e-15L, mean);
    EXPECT_LE(b.hi - b.lo, 1e-13);
    EXPECT_GE((f.with_radius(0.25)).mean_from(Bounds(from)).radius(), 0.25);
  });
  EXPECT_FALSE(TaylorModel::unknown().mean_from(Bounds(0.0)).finite());
}

}  // namespace
}  // namespace blendwright
