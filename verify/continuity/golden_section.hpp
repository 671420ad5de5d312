#pragma once
// Refines a sampled maximum between its neighbours.

namespace blendwright::detail {

struct Peak {
  double at = 0.0, value = 0.0;
};

/// A local maximum of f on [lo, hi] to within (hi - lo) * tolerance; the better of it and `start`, so the
/// result is never below a value that was sampled. f is called about 2 + 2.1 log(1 / tolerance) times.
/// Source: Kiefer, Sequential minimax search for a maximum, 1953.
template <class F>
[[nodiscard]] Peak golden_maximum(F f, double lo, double hi, Peak start, double tolerance = 1e-4) {
  constexpr double ratio = 0.6180339887498949;
  const double end = (hi - lo) * tolerance;
  Peak left{hi - ratio * (hi - lo), 0.0}, right{lo + ratio * (hi - lo), 0.0};
  left.value = f(left.at);
  right.value = f(right.at);
  while (hi - lo > end) {
    if (left.value >= right.value) {
      hi = right.at;
      right = left;
      left.at = hi - ratio * (hi - lo);
      left.value = f(left.at);
    } else {
      lo = left.at;
      left = right;
      right.at = lo + ratio * (hi - lo);
      right.value = f(right.at);
    }
  }
  const Peak best = left.value >= right.value ? left : right;
  return best.value > start.value ? best : start;
}

}  // namespace blendwright::detail
