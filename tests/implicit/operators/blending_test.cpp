// What blending operators promise beyond their golden values.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "implicit/operators/distance_operation.hpp"
#include "implicit/operators/hoffmann.hpp"
#include "tests/implicit/operators/op_tape.hpp"
#include "tests/implicit/operators/operator_names.hpp"

namespace blendwright::test {
namespace {

using detail::OperatorId;
using detail::OperatorValues;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double eps = std::numeric_limits<double>::epsilon();

std::shared_ptr<const Tape> tape_of(OperatorId id, const OperatorValues& v, std::size_t count = 2) {
  return combination_tape(detail::combination(id, v), count);
}
double value(const Tape& tape, double x1, double x2, double x3 = 0.0) {
  return sample(tape, {x1, x2, x3}).value;
}

// ---- Scale method
// ------------------------------------------------------------------------------------------

TEST(ScaleBlend, LiesBeyondTheSharpOperatorWithPartialsBetweenNoneAndOne) {
  for (const OperatorId id : {OperatorId::scale_union_one, OperatorId::scale_union_half})
    for_all(
        [&](Rng& rng) {
          const auto tape = tape_of(id, random_values(rng, id));
          const double x1 = uniform(rng, 0.0, 2.0), x2 = x1 * uniform(rng, 0.0, 2.5);
          const Sampled b = sample(*tape, {x1, x2, 0});
          if (id == OperatorId::scale_union_one)
            EXPECT_LE(b.value, std::min(x1, x2));
          else
            EXPECT_GE(b.value, std::max(x1, x2));
          for (int i = 0; i < 2; ++i) {
            EXPECT_GE(b.gradient[i], 0.0);
            EXPECT_LE(b.gradient[i], 1.0 + 4 * eps);
          }
        },
        2000);
}

TEST(ScaleBlend, StaysAboveTheOperandsItJoins) {  // B_SA2 >= max(x1/(1 + r1), x2/(1 + r2)) in its region
  for_all([](Rng& rng) {
    const OperatorValues v = random_values(rng, OperatorId::scale_union_one);
    const auto tape = tape_of(OperatorId::scale_union_one, v);
    const double x1 = uniform(rng, 0.1, 2.0);
    const double x2 = x1 * uniform(rng, 1.0 / (1.0 + v.r1), 1.0 + v.r2);
    const double least = std::max(x1 / (1.0 + v.r1), x2 / (1.0 + v.r2));
    EXPECT_GE(value(*tape, x1, x2), least * (1.0 - 4 * eps));
  });
}

TEST(ScaleBlend, IsRayLinear) {
  for (const OperatorId id : {OperatorId::scale_union_one, OperatorId::scale_intersection_one})
    for_all([&](Rng& rng) {
      const auto tape = tape_of(id, random_values(rng, id));
      const double x1 = uniform(rng, 0.1, 2.0), x2 = x1 * uniform(rng, 0.3, 3.0);
      const double a = log_uniform(rng, 1e-20, 1e20), one = value(*tape, x1, x2);
      // both values are rounded a few times, and the region's border may move by as much
      EXPECT_NEAR(value(*tape, a * x1, a * x2), a * one, 16 * eps * a * one);
    });
}

TEST(ScaleBlend, MeetsItsBordersSmoothly) {
  for (const OperatorId id : {OperatorId::scale_union_one, OperatorId::scale_intersection_one})
    for_all([&](Rng& rng) {
      OperatorValues v = random_values(rng, id);
      const double share = v.p / (v.r1 * v.r2);
      const auto tape = tape_of(id, v);
      const double k = id == OperatorId::scale_union_one ? 1.0 : -1.0;
      // x1 = (1 + k r1 (1 - t)) next to the border x1 = K1 x2, where B = x2. With e = r1 r2 t the sheet's
      // quadratic gives B - x2 = O(e^2/w) and partials that differ from (0, 1) by O(e/w), w = r1 r2 (1 -
      // share).
      const double t = 1e-9, size = t / (1.0 - share);
      const Sampled b = sample(*tape, {1.0 + k * v.r1 * (1.0 - t), 1.0, 0});
      EXPECT_NEAR(b.value, 1.0, 4 * eps + 10.0 * t * size);
      EXPECT_NEAR(b.gradient.x(), 0.0, 10.0 * size / v.r1);
      EXPECT_NEAR(b.gradient.y(), 1.0, 10.0 * size / v.r1);
    });
}

TEST(ScaleBlend, OfFullRangeIsTheEuclideanNorm) {
  const auto tape = tape_of(OperatorId::scale_union_half, {.r1 = 1.0, .r2 = 1.0, .p = 0.0});
  for_all([&](Rng& rng) {
    const double x1 = uniform(rng, 0.0, 1.0), x2 = uniform(rng, 0.0, 1.0);
    EXPECT_NEAR(value(*tape, x1, x2), std::hypot(x1, x2), 4 * eps);
  });
}

TEST(ScaleBlend, OfFullRangeNearsTheSum) {
  // p = 1 - w: h = x1 + x2 - O(sqrt(w)), as the arc E^2 = 2 w y1 y2 leaves its chord E = 0
  const auto tape = tape_of(OperatorId::scale_union_half, {.r1 = 1.0, .r2 = 1.0, .p = 1.0 - 1e-6});
  EXPECT_NEAR(value(*tape, 0.3, 0.4), 0.7, 2.0 * std::sqrt(2e-6));
  EXPECT_LT(value(*tape, 0.3, 0.4), 0.7);
}

TEST(ScaleBlend, NearsACornerForLargeNegativeP) {
  // At (1, 1) the distance t to the corner solves (sum t - r1 r2)^2 = 2 w t^2: t = r1 r2/(sum + sqrt(2 w)).
  const double w = 0.4 + 1e12;
  for (const double k : {1.0, -1.0}) {
    const OperatorId id = k > 0.0 ? OperatorId::scale_union_one : OperatorId::scale_intersection_one;
    const double t = 0.4 / (1.3 + k * 0.4 + std::sqrt(2.0 * w));
    EXPECT_NEAR(value(*tape_of(id, {.r1 = 0.5, .r2 = 0.8, .p = -1e12}), 1.0, 1.0), 1.0 - k * t, 4 * eps);
  }
}

TEST(ScaleBlend, KeepsFarAndNearNumbers) {
  const auto lower = tape_of(OperatorId::scale_union_one, {.r1 = 0.5, .r2 = 0.5, .p = 0.1});
  const auto upper = tape_of(OperatorId::scale_intersection_one, {.r1 = 0.5, .r2 = 0.5, .p = 0.1});
  EXPECT_EQ(value(*lower, infinity, 2.0), 2.0);
  EXPECT_EQ(value(*upper, infinity, 2.0), infinity);
  EXPECT_EQ(value(*lower, infinity, infinity), infinity);
  EXPECT_EQ(value(*lower, 0.0, 0.0), 0.0);
  EXPECT_EQ(value(*upper, 0.0, 0.0), 0.0);
}

// ---- Hoffmann
// ----------------------------------------------------------------------------------------------

TEST(HoffmannBlend, LiesOnItsConic) {
  for_all([](Rng& rng) {
    const OperatorValues v = random_values(rng, OperatorId::hoffmann_union_zero);
    const auto tape = tape_of(OperatorId::hoffmann_union_zero, v);
    const double x2 = uniform(rng, -1.0, 1.0), x1 = x2 + uniform(rng, -v.r2, v.r1), h = value(*tape, x1, x2);
    const auto conic = op_tape(detail::HoffmannPolynomial{v.r1, v.r2, v.p}, 2);
    // B_H of numbers that are wrong by eps, times its slope, which is at most the sum of its coefficients
    const double size = 2.0 * (v.r1 + v.r2) * (v.r1 + v.r2) + 2.0 * std::abs(v.p);
    EXPECT_NEAR(value(*conic, x1 - h, x2 - h), 0.0, 32 * eps * size * (1.0 + v.r1 + v.r2));
    EXPECT_LE(h, std::min(x1, x2));
    const Sampled b = sample(*tape, {x1, x2, 0});
    EXPECT_NEAR(b.gradient.x() + b.gradient.y(), 1.0, 4 * eps);
    EXPECT_GE(b.gradient.x(), 0.0);
    EXPECT_GE(b.gradient.y(), 0.0);
  });
}

TEST(ZeroOperators, AreEachOthersDuals) {
  const auto check = [](OperatorId unite, OperatorId intersect, OperatorId subtract, double x1, double x2,
                        const OperatorValues& v) {
    EXPECT_EQ(value(*tape_of(intersect, v), x1, x2), -value(*tape_of(unite, v), -x1, -x2));
    EXPECT_EQ(value(*tape_of(subtract, v), x1, x2), value(*tape_of(intersect, v), x1, -x2));
  };
  for_all([&](Rng& rng) {
    const OperatorValues v = random_values(rng, OperatorId::hoffmann_union_zero);
    const double x1 = uniform(rng, -1, 1), x2 = uniform(rng, -1, 1);
    check(OperatorId::hoffmann_union_zero, OperatorId::hoffmann_intersection_zero,
          OperatorId::hoffmann_difference_zero, x1, x2, v);
    check(OperatorId::lse_union_zero, OperatorId::lse_intersection_zero, OperatorId::lse_difference_zero, x1,
          x2, v);
  });
}

TEST(LseUnion, IsTheLogarithmOfRiccis) {
  for_all([](Rng& rng) {
    const OperatorValues v{.n = log_uniform(rng, 0.3, 20.0)};
    const double x1 = uniform(rng, -2, 2), x2 = uniform(rng, -2, 2);
    const double ricci = value(*tape_of(OperatorId::ricci_union_one, v), std::exp(x1), std::exp(x2));
    EXPECT_NEAR(value(*tape_of(OperatorId::lse_union_zero, v), x1, x2), std::log(ricci),
                32 * eps * (2.0 + 1.0 / v.n));
  });
}

// ---- Ricci
// -------------------------------------------------------------------------------------------------

TEST(Ricci, NearsTheSharpOperatorsForLargeExponents) {
  const OperatorValues v{.n = 1e6};
  // k^(1/n) - 1 <= ln 3/n
  EXPECT_NEAR(value(*tape_of(OperatorId::ricci_union_one, v, 3), 0.7, 0.7, 0.9), 0.7, 1.1e-6);
  EXPECT_NEAR(value(*tape_of(OperatorId::ricci_union_half, v, 3), 0.7, 0.7, 0.4), 0.7, 1.1e-6);
}

TEST(Ricci, IsAssociative) {
  for (const OperatorId id : {OperatorId::ricci_union_one, OperatorId::ricci_intersection_one})
    for_all([&](Rng& rng) {
      const OperatorValues v{.n = log_uniform(rng, 0.3, 20.0)};
      const double x = uniform(rng, 0, 2), y = uniform(rng, 0, 2), z = uniform(rng, 0, 2);
      const auto two = tape_of(id, v);
      const double all = value(*tape_of(id, v, 3), x, y, z);
      EXPECT_NEAR(all, value(*two, value(*two, x, y), z), 64 * eps * all * (1.0 + 1.0 / v.n));
    });
}

TEST(Ricci, DropsWhatDoesNotCount) {
  for (const double n : {0.4, 1.0, 2.0, 3.5, 20.0}) {
    const auto unite = tape_of(OperatorId::ricci_union_half, {.n = n}, 3);
    EXPECT_EQ(value(*unite, 0.0, 0.37, 0.0), 0.37);
    const auto one = tape_of(OperatorId::ricci_union_one, {.n = n}, 3);
    EXPECT_EQ(value(*one, infinity, 0.37, infinity), 0.37);
    EXPECT_EQ(value(*one, 0.0, 0.37, 0.0), 0.0);
    EXPECT_EQ(value(*one, infinity, infinity, infinity), infinity);
    EXPECT_EQ(value(*tape_of(OperatorId::ricci_intersection_one, {.n = n}, 3), infinity, 1.0, 0.0), infinity);
    EXPECT_EQ(value(*tape_of(OperatorId::ricci_difference_one, {.n = n}), 0.5, 0.0), infinity);
  }
}

// ---- Soft and sharp
// ------------------------------------------------------------------------------------------

TEST(SoftOperators, AreDualsUnderTheComplement) {
  for_all([](Rng& rng) {
    const double a = uniform(rng, 0, 1), b = uniform(rng, 0, 1), c = uniform(rng, 0, 1);
    const auto sum = [](double x, double y, double z) { return std::max(0.0, 1.0 - (3.0 - x - y - z)); };
    EXPECT_NEAR(value(*tape_of(OperatorId::soft_intersection, {}, 3), a, b, c), sum(a, b, c), 8 * eps);
    EXPECT_NEAR(value(*tape_of(OperatorId::soft_difference, {}, 3), a, b, c), std::max(0.0, a - b - c),
                8 * eps);
  });
}

TEST(SharpOperators, TakeTheFirstOnTies) {
  for (const OperatorId id : {OperatorId::min, OperatorId::max}) {
    const Sampled f = sample(*tape_of(id, {}), {0.25, 0.25, 0});
    EXPECT_EQ(f.value, 0.25);
    EXPECT_EQ(f.gradient, Vec3(1, 0, 0));
  }
}

// ---- Distance operations
// -----------------------------------------------------------------------------------

TEST(Dilation, AddsRadiiAndErosionTakesThemAway) {
  for_all([](Rng& rng) {
    const double n = integer(rng, 0, 2) == 0 ? 1.0 : log_uniform(rng, 0.3, 8.0);
    const double big = uniform(rng, 0.5, 3.0), small = big * uniform(rng, 0.05, 0.95);
    const double both = std::pow(std::pow(big, n) + std::pow(small, n), 1.0 / n);
    const double rest = std::pow(std::pow(big, n) - std::pow(small, n), 1.0 / n);
    // of powers that cancel by up to 1/(1 - 0.95^n), and are rooted
    const double slack = 64 * eps * (1.0 + 1.0 / n) * (1.0 + 20.0 / n);
    const auto dilated = op_tape(detail::Dilation(n), 2), eroded = op_tape(detail::Erosion{n}, 2);
    EXPECT_NEAR(value(*dilated, 1.0 / big, 1.0 / small) * both, 1.0, slack);
    EXPECT_NEAR(value(*eroded, 1.0 / big, 1.0 / small) * rest, 1.0, slack);
    EXPECT_NEAR(value(*eroded, value(*dilated, 1.0 / big, 1.0 / small), 1.0 / small) * big, 1.0, 10 * slack);
  });
}

TEST(Erosion, IsInfiniteWithoutSlopeWhereItCutsThrough) {
  for (const double n : {0.3, 1.0, 2.5}) {
    const auto tape = op_tape(detail::Erosion{n}, 2);
    for (const auto& [d, t] :
         {std::pair{0.5, 0.5}, {0.5, 0.2}, {1e-50, 0.0}, {infinity, 1.0}, {infinity, infinity}}) {
      const Sampled e = sample(*tape, {d, t, 0});
      EXPECT_EQ(e.value, infinity) << n << " " << d << " " << t;
      EXPECT_EQ(e.gradient, Vec3(0, 0, 0));
    }
    EXPECT_EQ(value(*tape, 0.0, 0.0), 0.0);
    EXPECT_EQ(value(*tape, 0.0, 1.0), 0.0);
    EXPECT_EQ(value(*tape, 0.3, infinity), 0.3);
    const Range steep = tape->range({Vec3(0.3, 0.4, 0), Vec3(0.5, 0.6, 1)});
    EXPECT_EQ(steep.hi, infinity);
    EXPECT_LT(steep.lo, value(*tape, 0.3, 0.6) * (1 + eps));
    EXPECT_EQ(tape->range({Vec3(0.5, 0.1, 0), Vec3(0.6, 0.5, 1)}), (Range{infinity, infinity}));
  }
}

}  // namespace
}  // namespace blendwright::test
