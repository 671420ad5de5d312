#pragma once
// Typed boundary data as a surface, so that a side without a primary is measured against what was typed.
#include "kernel/geometry/curve.hpp"
#include "kernel/geometry/surface.hpp"
#include "parametric/cross_tangent/end_condition.hpp"

namespace blendwright {

/// P(u, v) = C(v) + u T(v) + u^2/2 D(v), |u| <= 0.01: meets the data at u = 0 in position, tangent plane and,
/// for data of second order, normal curvature. The side u < 0 is the kept one of the blend's start, u > 0 of
/// its end. Partial derivatives are exact to order 2 in v; higher ones are 0.
class BoundaryStrip {
 public:
  BoundaryStrip(EndCondition end, int side) : end_(std::move(end)), side_(side) {}
  [[nodiscard]] SurfaceJet jet(UV p) const;
  [[nodiscard]] SurfacePartials partials(UV p) const;
  [[nodiscard]] SurfaceDomain domain() const;
  /// Along its line u = 0.
  void enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const;
  /// The line u = 0 of the strip.
  [[nodiscard]] Curve2 line() const;

 private:
  EndCondition end_;
  int side_;
};

}  // namespace blendwright
