#pragma once
// The blend as a B-spline surface: degree 5, graded knots in u, the cross derivatives at the trimlines exact.
//
//   |S - S~| <= sum_k (eps_k sup|B_k| + (sup|phi_k| + eps_k) eta_k)                                            (1)
// eps_k, eta_k: sup-norm errors of the splines of phi_k and B_k. Because the u-interpolation keeps orders 0, 1, 2 at
// both ends, the G1 and G2 defect at a trimline is that of the v-interpolation alone. Source: formula sheet, section 7.
#include "kernel/base/progress.hpp"
#include "kernel/geometry/bspline.hpp"
#include "parametric/ode/ode_blend.hpp"

namespace blendwright {

struct BlendFitOptions {
  double position = 1e-7;            ///< model units, over the whole surface: bound (1)
  Radians angle = degrees(1e-4);     ///< at the trimlines
  double curvature = 1e-5;           ///< at G2 trimlines, 1/model unit
  int max_control_points = 200000;
};

struct BlendFitReport {
  double position_bound = 0.0;       ///< (1), with eps_k and eta_k bounded between the samples too
  Radians angle_estimate;            ///< largest sampled at the trimlines
  double curvature_estimate = 0.0;
  int spans_u = 0, spans_v = 0;
  int control_points = 0;
};

struct BlendFit {
  BSplineSurface surface;            ///< u in [0, 1], v as in the blend; periodic in v when closed
  BlendFitReport report;
};

/// Throws ConvergenceError when max_control_points do not suffice; says what was reached.
[[nodiscard]] BlendFit fit_blend(const OdeBlend& blend, const BlendFitOptions& options, const Progress& progress = {});

}  // namespace blendwright
