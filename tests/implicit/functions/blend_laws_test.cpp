// What Liming's, Rockwood's and the local blends must be, from their definitions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "implicit/operators/function_liming.hpp"
#include "implicit/operators/function_local.hpp"
#include "implicit/operators/function_rockwood.hpp"
#include "implicit/operators/hoffmann.hpp"
#include "implicit/operators/sharp.hpp"
#include "tests/implicit/functions/argument_tape.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

using detail::SuperEllipse;

// ---- Liming ------------------------------------------------------------------------------------------

Combination clipped(double c_a, double c_b, double r, double u, Join join = Join::unite) {
  return step(detail::LimingClipped{c_a, c_b, r, u, join});
}

/// B_H = (r2 x1 + r1 x2 - r1 r2)^2 - 2 (r1 r2 - p) x1 x2 is -L/u with A = r2 x1, B = r1 x2, P = r1 r2 - A - B
/// and u = r1 r2/(3 r1 r2 - 2 p).
TEST(Liming, IsHoffmannAndHopcroftsBlend) {
  for_all([](Rng& rng) {
    const double r1 = uniform(rng, 0.3, 2.0), r2 = uniform(rng, 0.3, 2.0), r = r1 * r2;
    // p = 0, the ellipse, is u = 1/3.
    const double p = integer(rng, 0, 3) == 0 ? 0.0 : uniform(rng, -2.0, 0.9) * r;
    const double u = p == 0.0 ? 1.0 / 3.0 : r / (3.0 * r - 2.0 * p);
    const double x1 = uniform(rng, -2.0, 2.0), x2 = uniform(rng, -2.0, 2.0), A = r2 * x1, B = r1 * x2;
    const double liming = value(step(detail::Liming{u, 1}), {A, B, r - A - B});
    const double hoffmann = value(step(detail::HoffmannPolynomial{r1, r2, p}), {x1, x2});
    // terms up to (2 + 2 + 4)^2 and (r1 r2 - p) x1 x2 up to 50
    EXPECT_NEAR(liming, -u * hoffmann, 1e-13);
  });
}

/// Of lines at right angles, u = 1/3: |X - (1, 1)| = 1. Points of the curve are found from their angle.
TEST(Liming, OfARightAngleIsACircle) {
  for_all([](Rng& rng) {
    const double angle = uniform(rng, std::numbers::pi, 1.5 * std::numbers::pi);
    const double x = 1.0 + std::cos(angle), y = 1.0 + std::sin(angle);
    const Partials at = partials(step(detail::Liming{1.0 / 3.0, 1}), {x, y, 1.0 - x - y});
    // The distance from the curve to first order, by the gradient in x and y.
    const double by_x = at.partials[0] - at.partials[2], by_y = at.partials[1] - at.partials[2];
    EXPECT_LE(std::abs(at.value) / std::hypot(by_x, by_y), 1e-12);
  });
}

/// On the line of symmetry the curve is at t = r/(2 + sqrt((1 - u)/u)).
TEST(Liming, MeetsTheLineOfSymmetryWhereItMust) {
  for_all([](Rng& rng) {
    const double u = uniform(rng, 0.02, 0.98), r = uniform(rng, 0.2, 3.0);
    const double t = r / (2.0 + std::sqrt((1.0 - u) / u));
    EXPECT_NEAR(value(step(detail::Liming{u, 1}), {t, t, r - 2.0 * t}), 0.0, 1e-15 * r * r);
    EXPECT_NEAR(value(clipped(1.0, 1.0, r, u), {-t, -t}), 0.0, 1e-15 * r * r);
  });
}

/// Of order n, L - (1 - u) A B is as flat as P^(n+1) where P = 0.
TEST(Liming, OfOrderNHasAContactOfOrderN) {
  for (const int n : {1, 2, 3, 5}) {
    const auto at = [&](double h) {
      return value(step(detail::Liming{0.4, n}), {0.0, 1.0, h});  // on A = 0
    };
    EXPECT_EQ(at(0.0), 0.0);
    EXPECT_NEAR(at(0.02) / at(0.01), std::pow(2.0, n + 1), 1e-12 * std::pow(2.0, n + 1));
  }
}

/// The closing of {x <= 0} u {y <= 0} by r: in 0 < x, y < r the solid is |(x - r, y - r)| >= r.
TEST(LimingClipped, IsTheClosingOfARightAngle) {
  int inside_fillet = 0;
  for_all(
      [&](Rng& rng) {
        const double r = uniform(rng, 0.2, 2.0), x = uniform(rng, -1.0, 2.0) * r,
                     y = uniform(rng, -1.0, 2.0) * r;
        const double corner = std::hypot(x - r, y - r) - r;
        const bool fillet = x < r && y < r && corner > 0.0, solid = x <= 0.0 || y <= 0.0 || fillet;
        if (std::min({std::abs(x), std::abs(y), std::abs(corner)}) < 1e-9) return;
        const double phi = value(clipped(1.0, 1.0, r, 1.0 / 3.0), {-x, -y});
        EXPECT_EQ(phi >= 0.0, solid) << x << " " << y << " " << r;
        if (fillet && x > 0.0 && y > 0.0) ++inside_fillet;
      },
      4000);
  EXPECT_GT(inside_fillet, 50);
}

/// Inside where the fillet is, or where one of the solids is; dual joins have the dual solids.
TEST(LimingClipped, HasTheSolidsOfItsJoin) {
  for_all(
      [](Rng& rng) {
        const double c_a = uniform(rng, 0.3, 3.0), c_b = uniform(rng, 0.3, 3.0), r = uniform(rng, 0.2, 2.0);
        const double u = uniform(rng, 0.01, 0.99), f1 = uniform(rng, -3.0, 3.0), f2 = uniform(rng, -3.0, 3.0);
        const double any = value(clipped(c_a, c_b, r, u), {f1, f2});
        if (f1 > 0.0 || f2 > 0.0) {
          EXPECT_GT(any, 0.0);
        }
        if (f1 < 0.0 && f2 < 0.0) {
          const double P = std::max(0.0, r + c_a * f1 + c_b * f2);
          EXPECT_NEAR(any, u * P * P - (1.0 - u) * c_a * c_b * f1 * f2, 1e-14 * (1.0 + std::abs(any)));
        }
        EXPECT_EQ(value(clipped(c_a, c_b, r, u, Join::intersect), {f1, f2}),
                  -value(clipped(c_a, c_b, r, u), {-f1, -f2}));
        EXPECT_EQ(value(clipped(c_a, c_b, r, u, Join::subtract), {f1, f2}),
                  -value(clipped(c_a, c_b, r, u), {-f1, f2}));
      },
      2000);
}

/// Across f1 = 0 outside the other solid the value and the gradient are continuous.
TEST(LimingClipped, IsSmoothWhereItTouchesASolid) {
  for_all([](Rng& rng) {
    const double r = uniform(rng, 0.2, 2.0), u = uniform(rng, 0.05, 0.95), f2 = -uniform(rng, 0.1, 3.0);
    const Partials before = partials(clipped(1.3, 0.7, r, u), {-1e-9, f2});
    const Partials after = partials(clipped(1.3, 0.7, r, u), {1e-9, f2});
    EXPECT_NEAR(before.value, after.value, 1e-7);
    for (const std::size_t i : {0u, 1u}) EXPECT_NEAR(before.partials[i], after.partials[i], 1e-7);
    // On the surface it is tangent to f1 = 0.
    if (-0.7 * f2 > r) {
      EXPECT_NEAR(before.partials[1] / before.partials[0], 0.0, 1e-8);
    }
  });
}

// ---- Rockwood ----------------------------------------------------------------------------------------

std::vector<double> fields(Rng& rng, std::size_t k) {
  std::vector<double> f;
  for (std::size_t i = 0; i < k; ++i) f.push_back(uniform(rng, -2.0, 2.0));
  return f;
}
std::vector<double> reaches(Rng& rng, std::size_t k) {
  std::vector<double> r;
  for (std::size_t i = 0; i < k; ++i) r.push_back(log_uniform(rng, 0.1, 2.0));
  return r;
}
double any_weight(Rng& rng) {
  return integer(rng, 0, 2) == 0 ? integer(rng, 1, 4) : log_uniform(rng, 1.01, 40.0);
}
double K(const std::vector<double>& r, double w, const std::vector<double>& a) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(std::max(0.0, 1.0 - a[i] / r[i]), w);
  return 1.0 - sum;
}

TEST(Rockwood, MeetsTheQuotedValue) {
  EXPECT_NEAR(value(rockwood({1.0, 1.0}, 2.0, Join::intersect), {0.25, 0.25}), -0.042893218813452476, 1e-13);
  EXPECT_NEAR(value(step(detail::RockwoodRaw{SuperEllipse({1.0, 1.0}, 2.0)}), {-0.25, -0.25}), 0.125, 1e-15);
}

/// K and h have the same sign everywhere; the arguments less h have K = 0.
TEST(Rockwood, HasTheSignOfKAndMovesToItsZero) {
  int blended = 0;
  for_all(
      [&](Rng& rng) {
        const std::size_t k = 2 + rng.next() % 3;
        const std::vector<double> a = fields(rng, k), r = reaches(rng, k);
        const double w = any_weight(rng), h = value(rockwood(r, w, Join::intersect), a), k_here = K(r, w, a);
        if (std::abs(k_here) > 1e-12 * w) {
          EXPECT_EQ(h > 0.0, k_here > 0.0) << w;
        }
        std::vector<double> moved = a, turned = a;
        for (double& x : moved) x -= h;
        // Powers of w have relative errors of w roundings each.
        EXPECT_NEAR(K(r, w, moved), 0.0, 1e-13 * (1.0 + w) / *std::min_element(r.begin(), r.end()));
        const double least = *std::min_element(a.begin(), a.end());
        if (h < least - 1e-9) ++blended;
        EXPECT_LE(h, least);
        for (std::size_t i = 1; i < k; ++i) turned[i] = -a[i];
        EXPECT_EQ(value(rockwood(r, w, Join::subtract), turned), h);
        std::vector<double> other = a;
        for (double& x : other) x = -x;
        EXPECT_EQ(value(rockwood(r, w, Join::unite), other), -h);
      },
      4000);
  EXPECT_GT(blended, 1000);
}

TEST(Rockwood, HasPartialsThatSumToOne) {
  for_all(
      [](Rng& rng) {
        const std::size_t k = 2 + rng.next() % 4;
        const Partials at = partials(rockwood(reaches(rng, k), any_weight(rng), Join::unite), fields(rng, k));
        double sum = 0.0;
        for (const double p : at.partials) {
          EXPECT_GE(p, 0.0);
          EXPECT_LE(p, 1.0 + 1e-15);
          sum += p;
        }
        EXPECT_NEAR(sum, 1.0, 1e-14);
      },
      2000);
}

/// w = 1 is the chamfer: h = (a1/r1 + a2/r2 - 1)/(1/r1 + 1/r2) where both count.
TEST(Rockwood, OfWeightOneIsAChamfer) {
  for_all([](Rng& rng) {
    const std::vector<double> r = reaches(rng, 2), a = fields(rng, 2);
    const double h = (a[0] / r[0] + a[1] / r[1] - 1.0) / (1.0 / r[0] + 1.0 / r[1]);
    const double exact = std::min({h, a[0], a[1]});
    EXPECT_NEAR(value(rockwood(r, 1.0, Join::intersect), a), exact, 1e-14);
  });
}

/// w = 2, r = 1 of two planes at right angles is a circle: points at h = 0 have the distance 1 from (1, 1).
TEST(Rockwood, OfWeightTwoIsAnArc) {
  for_all([](Rng& rng) {
    const double angle = uniform(rng, std::numbers::pi, 1.5 * std::numbers::pi);
    const double x = 1.0 + std::cos(angle), y = 1.0 + std::sin(angle);
    EXPECT_NEAR(value(rockwood({1.0, 1.0}, 2.0, Join::intersect), {x, y}), 0.0, 1e-14);
  });
}

/// Larger weights are nearer to the edge: at equal arguments h = a - r (1 - 2^(-1/w)).
TEST(Rockwood, OfLargeWeightTendsToMin) {
  double last = 1.0;
  for (const double w : {1.0, 1.5, 2.0, 7.3, 50.0, 1e3, 1e4}) {
    const double gap = 0.3 - value(rockwood({0.8, 0.8}, w, Join::intersect), {0.3, 0.3});
    EXPECT_NEAR(gap, 0.8 * -std::expm1(-std::log(2.0) / w), 1e-14);
    EXPECT_LT(gap, last);
    last = gap;
  }
}

/// Where a_2 - h = r_2 the second argument drops out. Differences of the partials there halve with the step
/// for w = 2 and fall as its power w - 1 for w = 1.5: the gradient is continuous. For w = 1 it jumps.
TEST(Rockwood, HasAContinuousGradientWhereAnArgumentDropsOut) {
  const auto jump = [](double w, double h) {
    const Combination combine = rockwood({1.0, 0.7}, w, Join::intersect);
    return std::abs(partials(combine, {0.0, 0.7 - h}).partials[1] -
                    partials(combine, {0.0, 0.7 + h}).partials[1]);
  };
  EXPECT_NEAR(jump(2.0, 1e-4) / jump(2.0, 1e-5), 10.0, 0.1);
  EXPECT_NEAR(jump(1.5, 1e-4) / jump(1.5, 1e-6), 10.0, 0.2);
  EXPECT_NEAR(jump(3.0, 1e-4) / jump(3.0, 1e-5), 100.0, 1.0);
  EXPECT_GT(jump(1.0, 1e-9), 0.4);
}

TEST(Rockwood, RisesByWhatItsArgumentsRise) {
  for_all([](Rng& rng) {
    const std::vector<double> f = fields(rng, 3), r = reaches(rng, 3);
    const double w = any_weight(rng), by = uniform(rng, -3.0, 3.0);
    std::vector<double> moved = f;
    for (double& x : moved) x += by;
    for (const Join join : {Join::unite, Join::intersect})
      EXPECT_NEAR(value(rockwood(r, w, join), moved), value(rockwood(r, w, join), f) + by, 1e-13);
  });
}

/// Infinite and huge operands decide or do not count.
TEST(Rockwood, TakesInfiniteOperands) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Combination combine = rockwood({1.0, 1.0}, 2.0, Join::intersect);
  EXPECT_EQ(value(combine, {0.3, infinity}), 0.3);
  EXPECT_EQ(value(combine, {0.3, -infinity}), -infinity);
  EXPECT_EQ(value(combine, {infinity, infinity}), infinity);
  EXPECT_EQ(value(combine, {1e300, 0.3}), 0.3);
  EXPECT_EQ(partials(combine, {infinity, 0.3}).partials, (std::vector{0.0, 1.0}));
}

/// Reaches that differ by orders of magnitude, and large weights, are solved too.
TEST(Rockwood, SolvesForUnlikeReaches) {
  for_all(
      [](Rng& rng) {
        const std::vector<double> r{log_uniform(rng, 1e-6, 1e6), log_uniform(rng, 1e-6, 1e6)};
        const double w = log_uniform(rng, 1.0, 1e4), size = std::min(r[0], r[1]);
        const std::vector<double> a{uniform(rng, 0.0, 1.0) * size, uniform(rng, 0.0, 1.0) * size};
        const double h = value(rockwood(r, w, Join::intersect), a), t = std::min(a[0], a[1]) - h;
        // The equation falls in t; h is between its neighbours on both sides of the root.
        const auto left = [&](double depth) {
          long double sum = 0.0L;
          for (int i = 0; i < 2; ++i) {
            const auto at = static_cast<std::size_t>(i);
            const long double x =
                1.0L - ((a[at] - std::min(a[0], a[1])) + static_cast<long double>(depth)) / r[at];
            sum += x > 0.0L ? std::pow(x, static_cast<long double>(w)) : 0.0L;
          }
          return sum - 1.0L;
        };
        const double off = 2e-15 * std::max(r[0], r[1]) + 1e-14 * t;
        if (t - off > 0.0) {
          EXPECT_GE(left(t - off), 0.0L) << w;
        }
        EXPECT_LE(left(t + off), 0.0L) << w;
      },
      2000);
}

// ---- Next to an edge ---------------------------------------------------------------------------------

Combination local(std::vector<double> r, double w, Join join) {
  return step(detail::LocalDisplacement{SuperEllipse(std::move(r), w), join});
}

TEST(LocalBlend, IsSharpWhereOmegaIsZeroAndWholeWhereItIsOne) {
  for_all([](Rng& rng) {
    const std::vector<double> f = fields(rng, 2), r = reaches(rng, 2);
    const double w = any_weight(rng);
    for (const Join join : joins) {
      const auto at = [&](double omega) { return value(local(r, w, join), {omega, f[0], f[1]}); };
      const double second = join == Join::subtract ? -f[1] : f[1];
      EXPECT_EQ(at(0.0), join == Join::unite ? std::max(f[0], f[1]) : std::min(f[0], second));
      EXPECT_EQ(at(1.0), value(rockwood(r, w, join), f));
      const double omega = uniform(rng, 0.1, 0.9);
      EXPECT_NEAR(at(omega), value(rockwood({omega * r[0], omega * r[1]}, w, join), f), 1e-14);
    }
  });
}

/// dh/domega = sum r_i dh/dr_i, and dK/dr_i = -(w/r_i^2) a_i (..)+^(w-1): with F = K(a - h, omega r) = 0, dh/
/// domega = (sum r_i dK/dr_i)/(sum dK/da_i).
TEST(LocalBlend, HasThePartialOfItsReaches) {
  int blended = 0;
  for_all([&](Rng& rng) {
    const std::vector<double> a = fields(rng, 2), r = reaches(rng, 2);
    const double w = uniform(rng, 1.2, 6.0), omega = uniform(rng, 0.2, 1.0);
    const Partials at = partials(local(r, w, Join::intersect), {omega, a[0], a[1]});
    double by_reach = 0.0, by_value = 0.0;
    for (const std::size_t i : {0u, 1u}) {
      const double ri = omega * r[i], y = a[i] - at.value, x = std::max(0.0, 1.0 - y / ri);
      by_reach += r[i] * -(w / (ri * ri)) * y * std::pow(x, w - 1.0);
      by_value += w / ri * std::pow(x, w - 1.0);
    }
    EXPECT_NEAR(at.partials[0], by_reach / by_value, 1e-11);
    if (at.partials[0] < -1e-3) ++blended;
  });
  EXPECT_GT(blended, 30);
}

TEST(Cutoff, RisesSmoothlyFromZeroToOne) {
  const Combination cutoff = step(detail::Cutoff{0.5});
  EXPECT_EQ(value(cutoff, {-0.1}), 0.0);
  EXPECT_EQ(value(cutoff, {0.0}), 0.0);
  EXPECT_EQ(value(cutoff, {0.25}), 0.5);
  EXPECT_EQ(value(cutoff, {0.5}), 1.0);
  EXPECT_EQ(value(cutoff, {7.0}), 1.0);
  for (const double end : {1e-5, 0.5 - 1e-5}) {
    const Partials at = partials(cutoff, {end});
    EXPECT_LT(at.partials[0], 60.0 * (2e-5) * (2e-5) * 1.01);  // 30 t^2/fade
    EXPECT_GT(at.partials[0], 0.0);
  }
  EXPECT_NEAR(partials(cutoff, {0.25}).partials[0], 30.0 / 16.0 / 0.5, 1e-14);
}

TEST(BoundedMaterial, IsExactlyNothingOutsideItsBounds) {
  for_all([](Rng& rng) {
    const Combination material = step(detail::BoundedMaterial{0.7, 1.1, 0.6, 0.9});
    const std::vector<double> f = fields(rng, 2);
    const Partials out = partials(material, {f[0], f[1], -uniform(rng, 0.0, 2.0)});
    EXPECT_EQ(out.value, 0.0);
    EXPECT_EQ(out.partials, (std::vector{0.0, 0.0, 0.0}));
    const double in = value(material, {f[0], f[1], uniform(rng, 0.01, 2.0)});
    EXPECT_GT(in, 0.0);
    EXPECT_LT(in, 0.7);
  });
  EXPECT_EQ(value(step(detail::BoundedMaterial{0.7, 1.1, 0.6, 0.9}), {0.0, 0.0, 1e-100}), 0.7);
  EXPECT_EQ(value(step(detail::BoundedMaterial{0.7, 1.1, 0.6, 0.9}), {0.0, 0.0, 0.0}), 0.0);
}

/// a0 (1 - q)^3/(1 + q), with the derivative -(1 - q)^2 (4 + 2 q)/(1 + q)^2 by q.
TEST(BoundedMaterial, FollowsItsRatio) {
  for_all([](Rng& rng) {
    const std::vector<double> f{uniform(rng, -2, 2), uniform(rng, -2, 2), uniform(rng, 0.1, 2)};
    const double a1 = 1.1, a2 = 0.6, a3 = 0.9;
    const double r1 = f[0] * f[0] / (a1 * a1) + f[1] * f[1] / (a2 * a2), r3 = f[2] * f[2] / (a3 * a3);
    const double q = r1 / (r1 + r3), by_q = -std::pow((1 - q) / (1 + q), 2) * (4 + 2 * q);
    const Partials at = partials(step(detail::BoundedMaterial{0.7, a1, a2, a3}), f);
    EXPECT_NEAR(at.value, 0.7 * std::pow(1 - q, 3) / (1 + q), 1e-14);
    EXPECT_NEAR(at.partials[0], 0.7 * by_q * r3 / std::pow(r1 + r3, 2) * 2 * f[0] / (a1 * a1), 1e-11);
    EXPECT_NEAR(at.partials[2], -0.7 * by_q * r1 / std::pow(r1 + r3, 2) * 2 * f[2] / (a3 * a3), 1e-11);
  });
}

}  // namespace
}  // namespace blendwright::test
