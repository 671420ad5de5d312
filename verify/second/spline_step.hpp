#pragma once
// Derivatives of B-spline surfaces by the complex step.
//
//   S_u(u, v) = Im S(u + i h, v) / h,  h = 1e-40: nothing is subtracted, so nothing is lost but h^2 (1)
// S by de Boor's algorithm, in complex numbers along the one parameter: knots and control points are all that
// is taken from the surface, none of its basis functions and none of its derivatives. Sources: C. de Boor, A
// practical guide to splines, 1978, chapter X; W. Squire, G. Trapp, Using complex variables to estimate
// derivatives of real functions, SIAM Review 1998.
#include "kernel/geometry/bspline.hpp"

namespace blendwright::detail {

struct SplineTangents {
  Vec3 Su, Sv;
  double error_u = 0.0, error_v = 0.0;  ///< rounding: 8 p eps max|control| / (length of the knot span)
};

/// At a knot, the derivative of the span that begins there; at the end of the domain, of the last span. A
/// periodic parameter must lie in its domain.
[[nodiscard]] SplineTangents complex_step(const BSplineSurface& surface, UV at);

/// Largest coordinate of the control points.
[[nodiscard]] double largest_control(const BSplineSurface& surface);

}  // namespace blendwright::detail
