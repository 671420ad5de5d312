#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "kernel/base/parallel_for.hpp"
#include "tests/parametric/random_blend.hpp"

namespace blendwright::test {
namespace {

std::vector<double> random_parameters(Rng& rng, std::size_t n, double hi) {
  std::vector<double> x(n);
  for (double& value : x) value = uniform(rng, 0.0, hi);
  return x;
}

/// Largest distance of the grid from jet().S.
double grid_error(const OdeBlend& blend, const std::vector<double>& u, const std::vector<double>& v,
                  std::span<const double> out) {
  double worst = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i)
    for (std::size_t j = 0; j < v.size(); ++j) {
      const double* p = &out[(i * v.size() + j) * 3];
      const double d = (Vec3(p[0], p[1], p[2]) - blend.jet({u[i], v[j]}).S).norm();
      if (!(d <= worst)) worst = std::isnan(d) ? HUGE_VAL : d;
    }
  return worst;
}

// Six or fewer products of data (at most 10) and functions (at most 1.5 kappa): some eps each, in another
// order.
constexpr double per_kappa = 16 * 15.0 * 0x1p-52;

TEST(EvaluateGrid, GivesTheBlendsPointsInEveryModeFrameAndOrder) {
  for_all([](Rng& rng) {
    const auto [shape, kappa] = random_shape(rng, 1e3);
    const OdeBlend blend = random_blend(rng, shape);
    const auto u = random_parameters(rng, static_cast<std::size_t>(integer(rng, 1, 9)), 1.0);
    const auto v = random_parameters(rng, static_cast<std::size_t>(integer(rng, 1, 70)), 6.28);
    const std::size_t n = 3 * u.size() * v.size(), offset = static_cast<std::size_t>(integer(rng, 0, 7));
    std::vector<double> memory(n + 9, -7.0);
    const std::span<double> out(memory.data() + offset + 1, n);
    evaluate_grid(blend, u, v, out);
    EXPECT_LE(grid_error(blend, u, v, out), per_kappa * kappa);
    EXPECT_EQ(memory[offset], -7.0);  // nothing is written beside the grid
    EXPECT_EQ(memory[offset + 1 + n], -7.0);
  });
}

TEST(EvaluateGrid, NoticesAWrongPoint) {
  Rng rng(2);
  const OdeBlend blend = random_blend(rng, {});
  const auto u = random_parameters(rng, 3, 1.0), v = random_parameters(rng, 5, 6.28);
  std::vector<double> out(45);
  evaluate_grid(blend, u, v, out);
  out[17] += 1e-11;
  EXPECT_GT(grid_error(blend, u, v, out), per_kappa);
}

TEST(EvaluateGrid, WritesLargeGridsWhole) {
  // Larger than the caches (streaming stores) and than one tile in both directions, with odd row lengths.
  for (const bool separate : {false, true}) {
    Rng rng(separate ? 4 : 3);
    BlendShape shape;
    shape.ode = {SweepOde{1, -5, 6.25}, SweepOde{1, separate ? -6.0 : -5.0, 6.25}, SweepOde{1, -5, 6.25}};
    const OdeBlend blend = random_blend(rng, shape);
    const auto u = random_parameters(rng, 23, 1.0), v = random_parameters(rng, 8197, 6.28);
    std::vector<double> out(3 * u.size() * v.size(), HUGE_VAL);
    evaluate_grid(blend, u, v, out);
    EXPECT_LE(grid_error(blend, u, v, out), per_kappa * 10.0);
  }
}

TEST(EvaluateGrid, GivesTheSameBytesForAnyThreadsAndAlignment) {
  for_all(
      [](Rng& rng) {
        const OdeBlend blend = random_blend(rng, random_shape(rng, 100.0).shape);
        const auto u = random_parameters(rng, 50, 1.0), v = random_parameters(rng, 1001, 6.28);
        const std::size_t n = 3 * u.size() * v.size();
        std::vector<double> one(n), many(n), shifted(n + 3);
        {
          const ThreadLimit serial(1);
          evaluate_grid(blend, u, v, one);
        }
        evaluate_grid(blend, u, v, many);
        evaluate_grid(blend, u, v, std::span<double>(shifted).subspan(3));
        EXPECT_EQ(std::memcmp(one.data(), many.data(), n * sizeof(double)), 0);
        EXPECT_EQ(std::memcmp(one.data(), shifted.data() + 3, n * sizeof(double)), 0);
      },
      12);
}

TEST(EvaluateGrid, RefusesAnOutputOfTheWrongSize) {
  Rng rng(2);
  const OdeBlend blend = random_blend(rng, {});
  std::vector<double> u{0.5}, v{1.0, 2.0}, out(5);
  EXPECT_THROW(evaluate_grid(blend, u, v, out), InputError);
  EXPECT_NO_THROW(evaluate_grid(blend, {}, v, {}));
}

}  // namespace
}  // namespace blendwright::test
