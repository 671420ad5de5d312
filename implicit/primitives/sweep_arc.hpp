#pragma once
// A profile swept along an arc of the circle of radius R about the z axis (section and ends:
// sweep_section.hpp).
//
//   C(t) = (R cos t, R sin t, 0),  t0 <= t <= t1 <= t0 + 2 pi,  U = (cos t, sin t, 0),  V = (0, 0, 1)
//   t = the angle of (x, y), on the branch around the arc's middle, clamped to [t0, t1]; k = (t - t0)/(t1 -
//   t0) u0 = r - R inside the arc, r = sqrt(x^2 + y^2);  v0 = z; at an end u0 = (X - C).U,  alpha = (X -
//   C).C'/|C'|                                                     (1)
//
// R > 0 (model units). A whole turn has no ends; with a circular profile it is a torus, and its section
// must close (same scale, a twist that maps the profile onto itself), else d jumps opposite the middle. On
// the axis the foot is not unique.
#include "implicit/eval/op.hpp"
#include "implicit/primitives/sweep_section.hpp"

namespace blendwright::detail {

struct SweepArc {
  Section section;
  double radius = 1.0;
  double middle = 0.0, half = 0.0;  ///< of the angles [t0, t1]
  double cos_middle = 1.0, sin_middle = 0.0, cos_half = 1.0, sin_half = 0.0;
  bool whole = false;
  SweepArc() = default;
  SweepArc(const Section& s, double R, double t0, double t1, bool whole_turn);
};

/// Encloses d <= value.
[[nodiscard]] Box sweep_arc_region(const SweepArc& body, double value);

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::SweepArc>();
}  // namespace blendwright
