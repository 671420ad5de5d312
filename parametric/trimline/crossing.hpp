#pragma once
// Where a trimline crosses or overlaps itself or another trimline of the same primary. Lines are compared in
// the primary's parameters, modulo the periods of its closed directions:
//   c(v0) = c(v1) + (k P_u, l P_v)   k, l whole numbers, 0 along open directions                          (1)
// Points where different parameters give one point of the primary (poles) are not seen.
#include <optional>

#include "parametric/trimline/trimline.hpp"

namespace blendwright {

/// One solution of (1). Newton holds it to 1e-9 of the lines' size, on the primary; of an overlap, which has
/// a whole stretch of solutions, it is one of them.
struct Crossing {
  double v0 = 0.0, v1 = 0.0;
  Vec3 point;
};

/// v0 < v1. The closing point of a closed line does not count, nor an open line whose ends meet. Loops
/// smaller than 1e-5 of the line are taken for cusps.
[[nodiscard]] std::optional<Crossing> self_crossing(const Trimline& line);

/// v0 on `line0`, v1 on `line1`. Both lie on the same primary, which the caller knows. Open lines may share
/// end points.
[[nodiscard]] std::optional<Crossing> crossing(const Trimline& line0, const Trimline& line1);

}  // namespace blendwright
