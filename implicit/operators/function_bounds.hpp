#pragma once
// Ranges and linear bounds that operators of level function are bounded with.
#include <algorithm>
#include <cmath>
#include <span>

#include "implicit/eval/linear_rules.hpp"
#include "implicit/operators/function_join.hpp"

namespace blendwright::detail {

// ---- Ranges

/// Of an operator that rises or falls with every argument as its join says: end points.
[[nodiscard]] Range ends_of_join(const Op& op, const void* body, std::span<const Range> args, Join join);
/// The largest finite end in magnitude.
[[nodiscard]] double size_of(std::span<const Range> args);

[[nodiscard]] inline Range operator*(Range a, Range b) {
  const double p[] = {a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi};
  return {*std::min_element(p, p + 4), *std::max_element(p, p + 4)};
}
[[nodiscard]] inline Range operator+(Range a, Range b) { return {a.lo + b.lo, a.hi + b.hi}; }
[[nodiscard]] inline Range operator*(double factor, Range a) {
  return factor < 0.0 ? Range{factor * a.hi, factor * a.lo} : Range{factor * a.lo, factor * a.hi};
}
[[nodiscard]] inline Range squared(Range a) {
  const Range m = magnitude(a);
  return {m.lo * m.lo, m.hi * m.hi};
}
[[nodiscard]] inline Range saturated(Range a) {
  return {std::clamp(a.lo, -saturation, saturation), std::clamp(a.hi, -saturation, saturation)};
}

// ---- Linear bounds

/// A function of arguments and its partials at a point.
struct ArgumentGradient {
  static constexpr std::size_t most = 8;
  double value = 0.0;
  double partials[most] = {};
};
/// By the scalar kernels; at most ArgumentGradient::most arguments.
[[nodiscard]] ArgumentGradient argument_gradient(const Op& op, const void* body, std::span<const double> at);

/// The arguments' values in the middle of the box, each in its range.
struct Middle {
  double at[ArgumentGradient::most] = {};
  double least[ArgumentGradient::most] = {}, most[ArgumentGradient::most] = {};  ///< of argument - at
  bool usable = false;  ///< all ranges are finite, and there are not too many
  explicit Middle(const LinearInput& in);
  [[nodiscard]] Range offset(std::size_t i) const { return {least[i], most[i]}; }
};

/// value + sum partials_i (argument_i - middle_i) + rest.
[[nodiscard]] LinearBound expansion_bound(const LinearInput& in, const Middle& middle,
                                          const ArgumentGradient& g, Range rest, double slack);
/// The same by the mean-value theorem, the partials lying in these ranges wherever the arguments lie in
/// theirs.
[[nodiscard]] LinearBound mean_value_bound(const LinearInput& in, const Middle& middle, double value,
                                           std::span<const Range> partials, double slack);

enum class Bend { concave, convex };
/// A concave (convex) function of its arguments: below (above) its tangent plane in the middle, by most in a
/// corner of the arguments' ranges. Its gradient must be one of a plane that is above (below) it. Cost: 2^k
/// values; up to five arguments, everything() else.
[[nodiscard]] LinearBound tangent_bound(const Op& op, const void* body, const LinearInput& in, Bend bend,
                                        double slack);
/// A function like min of arguments with a join's signs: it rises (falls) with each of them as the join says,
/// and when all rise (fall) by c it rises by c. Along the mean of their linear parts.
[[nodiscard]] LinearBound shift_bound(const Op& op, const void* body, const LinearInput& in, Join join,
                                      double slack);

}  // namespace blendwright::detail
