#pragma once
// Ranges of exact distances.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

/// The rounding error of an exact distance, relative to the sizes of the solid and of the coordinates: a few
/// dozen operations, each with a relative error of half a unit of round-off.
inline constexpr double distance_slack = 64.0 * std::numeric_limits<double>::epsilon();

/// Range of a distance that falls with |x|, |y| and |z|: end points.
[[nodiscard]] inline Range falling_distance_range(const Op& op, const void* body, const Box& local,
                                                  double size) {
  Vec3 near, far;
  for (int i = 0; i < 3; ++i) {
    const Range m = magnitude(local.axis(i));
    near[i] = m.lo;
    far[i] = m.hi;
  }
  const double hi = scalar_value(op, body, near) + distance_slack * (size + near.maxCoeff());
  if (!far.allFinite()) return {-std::numeric_limits<double>::infinity(), hi};
  return {scalar_value(op, body, far) - distance_slack * (size + far.maxCoeff()), hi};
}

}  // namespace blendwright::detail
