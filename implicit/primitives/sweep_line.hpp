#pragma once
// A profile swept along a segment (section and ends: sweep_section.hpp).
//
//   C(k) = p0 + k (p1 - p0),  W = (p1 - p0)/|p1 - p0|,  U the start direction made perpendicular to W,  V = W
//   x U k = clamp((X - p0).W / |p1 - p0|, 0, 1),  u0 = (X - p0).U,  v0 = (X - p0).V (1) alpha = (X - C(k)).W
//
// p0, p1 in model units. d rises along rays from the axis in a normal plane, but is not ray-linear.
#include "implicit/eval/op.hpp"
#include "implicit/primitives/sweep_section.hpp"

namespace blendwright::detail {

struct SweepLine {
  Section section;
  Vec3 start, U, V, W;
  double length = 1.0;
};

/// Encloses d <= value.
[[nodiscard]] Box sweep_line_region(const SweepLine& body, double value);

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::SweepLine>();
}  // namespace blendwright
