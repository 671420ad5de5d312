#pragma once
// One piece of a trimline: every figure of the certificate as an interval over it.
#include <string>

#include "kernel/math/interval.hpp"
#include "verify/continuity/seam.hpp"

namespace blendwright::detail {

struct SeamPiece {
  Interval v{};
  Bounds gap{}, angle{}, curvature{};
  std::string unproven{};  ///< why the surfaces have no enclosure here
};

/// `seam` has a primary and a pcurve.
[[nodiscard]] SeamPiece enclosed_piece(const Seam& seam, const Interval& v);

}  // namespace blendwright::detail
