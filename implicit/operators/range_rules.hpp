#pragma once
// What the ranges of operators share.
#include <cmath>

#include "implicit/eval/op.hpp"

namespace blendwright::detail {

/// Below this distances and fields are not told apart from 0, so that no derivative overflows.
inline constexpr double negligible = 1e-60;

/// Ends moved out by a relative and an absolute slack; infinite ends stay.
[[nodiscard]] inline Range spread(Range r, double relative, double absolute = 0.0) {
  if (std::isfinite(r.lo)) r.lo -= relative * std::abs(r.lo) + absolute;
  if (std::isfinite(r.hi)) r.hi += relative * std::abs(r.hi) + absolute;
  return r;
}
/// range_by_arguments() with infinite ends kept.
[[nodiscard]] inline Range ends(const Op& op, const void* body, std::span<const Range> args,
                                std::initializer_list<bool> rises) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Range r = range_by_arguments(op, body, args, rises);
  return {std::isnan(r.lo) ? infinity : r.lo, std::isnan(r.hi) ? -infinity : r.hi};
}
/// Of an operation that is never negative and takes what is below `negligible` for 0.
[[nodiscard]] inline Range spread_positive(Range r, double relative) {
  if (r.lo == 0.0 && r.hi == 0.0) return r;
  const Range wide = spread(r, relative, 10.0 * negligible);
  return {std::max(0.0, wide.lo), wide.hi};
}

/// All arguments are this number.
[[nodiscard]] inline bool is(const Range& arg, double number) { return arg.lo == number && arg.hi == number; }

}  // namespace blendwright::detail
