#pragma once
// Refines a sampled maximum between its neighbours.
#include <algorithm>
#include <cmath>
#include <limits>

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

/// The same maximum with its place to (hi - lo) * tolerance, where f is smooth around it: Newton's method on
///   f' = (45 (f1 - f-1) - 9 (f2 - f-2) + (f3 - f-3)) / (60 h) + O(h^6),  f'' = (f1 - 2 f0 + f-1) / h^2,
/// f_k = f(v + k h), h an eighth of the range or what fits in. Differences of values know a place to about
/// eps |f| / (h |f''|) only; steps that no longer get shorter are that, and end it. What is no maximum (a
/// kink, an end of the range, a plateau of rounding) stays as it was.
template <class F>
[[nodiscard]] Peak polished_maximum(F f, double lo, double hi, Peak best, double tolerance = 1e-12) {
  const double range = hi - lo, noise = 8.0 * std::numeric_limits<double>::epsilon();
  double v = best.at, before = 0.25 * range;
  for (int k = 0; k < 12; ++k) {
    const double h = std::min({0.125 * range, (v - lo) / 3.0, (hi - v) / 3.0});
    if (!(h > 1e-3 * range)) return best;
    const double top = f(v), f1 = f(v + h), b1 = f(v - h);
    const double slope =
        (45.0 * (f1 - b1) - 9.0 * (f(v + 2.0 * h) - f(v - 2.0 * h)) + (f(v + 3.0 * h) - f(v - 3.0 * h))) /
        (60.0 * h);
    const double bend = (f1 - 2.0 * top + b1) / (h * h), step = -slope / bend;
    // Bends below this are the rounding of the three values.
    if (!(bend * h * h < -noise * std::abs(top)) || !(std::abs(step) < before)) break;
    v += step;
    before = 0.5 * std::abs(step);
    if (std::abs(step) <= tolerance * range) break;
  }
  const Peak end{v, f(v)};
  return end.value >= best.value - noise * std::abs(best.value) ? end : best;
}

}  // namespace blendwright::detail
