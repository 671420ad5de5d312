#pragma once
// Trimlines moved along their primary by a smooth law: where a line is nearly right and a hand corrects it.
//
//   (u, v)_new(t) = (u, v)_line(t) + (du, dv)(t)        t in [0, 1], the fraction of the line's own range (1)
// (du, dv) is the quintic spline (C4) through the given points: periodic on closed lines; on open ones natural,
// with second and fourth derivative 0 at both ends, so that two points make a straight law. An open line
// without points at its ends has the shifts of its first and last point there. A single point shifts the whole
// line.
#include <string>
#include <vector>

#include "kernel/base/error.hpp"
#include "parametric/trimline/trimline.hpp"

namespace blendwright {

/// Shift (du, dv) at the fraction t of the line's range, in units of the primary's parameters (angles:
/// radians).
struct ShiftPoint {
  double t = 0.0;
  Vec2 by = Vec2::Zero();
  [[nodiscard]] bool operator==(const ShiftPoint& other) const { return t == other.t && by == other.by; }
};

/// What is wrong with the points: t outside [0, 1] or not increasing, a shift that is not finite, and on a
/// closed line different shifts at t = 0 and t = 1, which are one point of it. `where` goes in front.
[[nodiscard]] std::vector<Problem> check_shift(const std::vector<ShiftPoint>& points, bool closed,
                                               const std::string& where);

/// The line after (1), with exact derivatives and an enclosure if the line has one. No points: the line
/// itself. Throws InputError for what check_shift finds ("shift/2") and GeometryError as Trimline does, where
/// the line leaves an open domain of its primary; slack: model units, as there.
[[nodiscard]] Trimline shifted(const Trimline& line, const std::vector<ShiftPoint>& points,
                               double slack = 0.0);

}  // namespace blendwright
