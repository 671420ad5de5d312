#pragma once
// Refines a sampled maximum between its neighbours.
#include <algorithm>
#include <cmath>

namespace blendwright::detail {

struct Peak {
  double at = 0.0, value = 0.0;
};

/// A local maximum of f on [lo, hi] from a sampled point within, to about (hi - lo) * tolerance: golden
/// section, with parabolic steps where they converge; a smooth f takes some six calls, a kink about 2.1
/// log(1/tolerance). Never below `start`. Source: Brent, Algorithms for minimization without derivatives,
/// 1973, chapter 5.
template <class F>
[[nodiscard]] Peak local_maximum(F f, double lo, double hi, Peak start, double tolerance = 1e-3) {
  constexpr double ratio = 0.3819660112501051;  // 2 - golden ratio
  const double close = 0.5 * tolerance * (hi - lo);
  Peak best = start, second = start, third = start;
  double step = 0.0, before = 0.0;  // the last step, and the one before it
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (lo + hi);
    if (std::abs(best.at - middle) <= 2.0 * close - 0.5 * (hi - lo)) break;
    // Vertex of the parabola through the three best points, taken when it lies inside and steps get shorter.
    const double r = (best.at - second.at) * (best.value - third.value);
    const double q = (best.at - third.at) * (best.value - second.value);
    const double p = (best.at - third.at) * q - (best.at - second.at) * r, denominator = 2.0 * (q - r);
    const double vertex =
        best.at - p / denominator;  // not finite when the points coincide: fails the test below
    const bool parabolic = std::abs(vertex - best.at) < 0.5 * std::abs(before) && vertex > lo && vertex < hi;
    if (parabolic) {
      before = step;
      step = vertex - best.at;
    } else {
      before = best.at < middle ? hi - best.at : lo - best.at;
      step = ratio * before;
    }
    const double length = std::max(std::abs(step), close);
    const double at = std::clamp(best.at + std::copysign(length, step), lo, hi);
    const Peak next{at, f(at)};
    if (next.value >= best.value) {
      (at >= best.at ? lo : hi) = best.at;
      third = second;
      second = best;
      best = next;
    } else {
      (at < best.at ? lo : hi) = at;
      if (next.value >= second.value || second.at == best.at) {
        third = second;
        second = next;
      } else if (next.value >= third.value || third.at == best.at || third.at == second.at) {
        third = next;
      }
    }
  }
  return best;
}

}  // namespace blendwright::detail
