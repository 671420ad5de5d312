#pragma once
// A profile swept along any regular curve (section and ends: sweep_section.hpp).
//
//   C(t), t0 <= t <= t1, with a rotation-minimising frame (U, V, W), V = W x U (sweep_path.hpp) t: parameter
//   of the globally nearest point;  k = (t - t0)/(t1 - t0) u0 = (X - C(t)).U,  v0 = (X - C(t)).V,  alpha = (X
//   - C(t)).W                                           (1) dt/dX = C'/(|C'|^2 - (X - C).C'')  where t lies
//   inside, else 0                                         (2)
//
// Where the nearest point is not unique (the medial axis) d may jump; at a centre of curvature (2) is
// infinite and counts as 0. A closed curve (C and C' agree at both ends) has no ends; a transported frame
// comes back turned by some angle, which is undone evenly along the curve by a twist of its own, so that d is
// continuous when the section closes (same scale; a twist that maps the profile onto itself). A profile that
// the angle maps onto itself (a circle: any) needs none.
//
// Kernels work point by point: the search of t dominates. Ranges: the distance to the curve has the Lipschitz
// constant 1; where all points of a box have one foot each, u0 and v0 have too and t moves by (2), so the
// range tends to the exact one.
#include <memory>

#include "implicit/eval/op.hpp"
#include "implicit/primitives/sweep_path.hpp"
#include "implicit/primitives/sweep_section.hpp"

namespace blendwright::detail {

struct SweepCurve {
  Section section;  ///< its twist closes a closed path
  std::shared_ptr<const Path> path;
  bool seamless = false;  ///< closed, and the section closes
  /// s: with the twist that is asked for.
  SweepCurve(const Section& s, std::shared_ptr<const Path> p);
};

/// Encloses d <= value.
[[nodiscard]] Box sweep_curve_region(const SweepCurve& body, double value);

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::SweepCurve>();
}  // namespace blendwright
