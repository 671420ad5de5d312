#pragma once
// Small strong types where a mix-up would compile silently: angles, parameter points, intervals.
// Lengths are plain double in model units; the unit is named once, in the job and in the STEP header.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>

namespace blendwright {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

/// An angle. Radians everywhere inside; degrees exist only in job keys ending in _deg, in flags and in
/// reports.
struct Radians {
  double value = 0.0;
  constexpr Radians() = default;
  explicit constexpr Radians(double v) : value(v) {}
  [[nodiscard]] constexpr double degrees() const { return value * (180.0 / std::numbers::pi); }
  auto operator<=>(const Radians&) const = default;
};
[[nodiscard]] constexpr Radians degrees(double d) { return Radians(d * (std::numbers::pi / 180.0)); }

/// A point of a surface's parameter domain; never confused with a point of a plane.
struct UV {
  double u = 0.0, v = 0.0;
  bool operator==(const UV&) const = default;
};

/// Closed interval [lo, hi] of a parameter; lo < hi in a valid domain.
struct Interval {
  double lo = 0.0, hi = 1.0;
  [[nodiscard]] constexpr double length() const { return hi - lo; }
  [[nodiscard]] constexpr double at(double t) const { return lo + t * (hi - lo); }  ///< t in [0, 1]
  [[nodiscard]] constexpr double middle() const { return 0.5 * (lo + hi); }
  [[nodiscard]] constexpr bool contains(double x, double slack = 0.0) const {
    return x >= lo - slack && x <= hi + slack;
  }
  [[nodiscard]] constexpr double clamp(double x) const { return x < lo ? lo : (x > hi ? hi : x); }
  bool operator==(const Interval&) const = default;
};

/// The unit that model lengths are written in.
enum class LengthUnit { millimetre, centimetre, metre, inch };

/// What a joint is asked to reach, or has reached: position, tangent plane, normal curvature.
enum class Continuity { none = -1, G0 = 0, G1 = 1, G2 = 2 };
[[nodiscard]] const char* name(Continuity c);
[[nodiscard]] const char* name(LengthUnit u);  ///< "mm", "cm", "m", "in"

/// What counts as continuous. position: model units. angle: between tangent planes. curvature: |k_blend -
/// k_primary| of the normal curvature across the trimline, 1/model unit.
struct Tolerance {
  double position = 1e-6;
  Radians angle = degrees(1e-3);
  double curvature = 1e-4;
};

}  // namespace blendwright
