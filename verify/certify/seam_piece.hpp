#pragma once
// One piece of a trimline: every figure of the certificate as an interval over it.
#include <string>

#include "kernel/math/interval.hpp"
#include "verify/continuity/seam.hpp"

namespace blendwright::detail {

struct SeamPiece {
  Interval v{};
  Bounds gap{}, angle{}, curvature{};
  bool stops = false;      ///< the trimline stops at an end of the piece: no normal there, but a limit
  std::string unproven{};  ///< why the surfaces have no enclosure here
};

/// `seam` has a primary and a pcurve. `least_normal`: see SeamProbe.
///
/// Where the trimline stops, at an end e of the piece, both normals vanish there and
///   nS(v) = nS(e) + t mS(v), mS = the mean of nS' between e and v, t = v - e (1)
/// and the same of nP: the angle between nS/t and nP/t is bounded through the limit t -> 0. nS(e) is 0 but
/// for rounding; places with |nS| <= least_normal / 2, at which samples look further inside, are left out, so
/// that t is no smaller than
///   t0 = (least_normal / 2 - |nS(e)|) / max |mS| (2)
[[nodiscard]] SeamPiece enclosed_piece(const Seam& seam, const Interval& v, double least_normal);

}  // namespace blendwright::detail
