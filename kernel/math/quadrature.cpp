#include "kernel/math/quadrature.hpp"

#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <string>

#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

constexpr int most = 64;

QuadratureRule make_rule(int n) {
  const auto count = static_cast<std::size_t>(n);
  QuadratureRule rule{std::vector<double>(count), std::vector<double>(count)};
  for (int i = 0; i < (n + 1) / 2; ++i) {
    // Newton on the Legendre polynomial P_n from the Tricomi estimate, on [-1, 1]; by symmetry half of the
    // roots.
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 0.0;
    for (int pass = 0; pass < 8; ++pass) {
      double previous = 1.0, value = x;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
        previous = value;
        value = next;
      }
      slope = n * (previous - x * value) / (1.0 - x * x);
      const double step = value / slope;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    if (2 * i + 1 == n) x = 0.0;
    const auto lo = static_cast<std::size_t>(i), hi = count - 1 - lo;
    const double weight = 1.0 / ((1.0 - x * x) * slope * slope);  // half of the weight on [-1, 1]
    rule.x[lo] = 0.5 - 0.5 * x;
    rule.x[hi] = 0.5 + 0.5 * x;
    rule.w[lo] = rule.w[hi] = weight;
  }
  return rule;
}

}  // namespace

const QuadratureRule& gauss_legendre(int n) {
  if (n < 1 || n > most) throw InputError("n", "is " + std::to_string(n) + ", must be in [1, 64]");
  static std::array<QuadratureRule, most> rules;
  static std::array<std::once_flag, most> made;
  const auto i = static_cast<std::size_t>(n - 1);
  std::call_once(made[i], [&] { rules[i] = make_rule(n); });
  return rules[i];
}

}  // namespace blendwright
