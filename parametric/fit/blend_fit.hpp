#pragma once
// The blend as a B-spline surface: degree 5, graded knots in u, the cross derivatives at the trimlines exact.
//
//   |S - S~| <= sum_k (eps_k sup|B_k| + (sup|phi_k| + eps_k) eta_k) (1)
// eps_k, eta_k: sup-norm errors of the splines of phi_k and B_k. Because the u-interpolation keeps orders 0,
// 1, 2 at both ends, the G1 and G2 defect at a trimline is that of the v-interpolation alone. Source: formula
// sheet, section 7.
//
// How far the bound reaches. eps_k: from samples of the error and its second and fourth derivative and the
// differential equation between them; proven for the fourth order but for rounding, and for the sixth order
// but for a term below 1 % that is estimated (cardinal_fit.hpp). sup|B_k|: control hull of its spline.
// eta_k: 1.91 times the largest of 5 samples per span, which bounds the leading term of a quintic's error;
// the data along v are known as functions only, so this part is as good as their smoothness: for trimlines
// with less than six continuous derivatives it is an estimate (boundary_fit.hpp). In the second sum of (1), S
// is taken as a sum over the data C_i, T_i, D_i themselves, so that chord mode does not count the chord
// twice. Blends with a moving frame are interpolated as a whole; their bound is 1.91^2 times the largest of
// 25 samples per span. Breaks in u are graded to the boundary layers, in v they are moved to where the data
// need them; neighbouring spans are within a factor 4. Angle and curvature are held to half of the request at
// the samples.
#include "kernel/base/progress.hpp"
#include "kernel/geometry/bspline.hpp"
#include "parametric/ode/ode_blend.hpp"

namespace blendwright {

struct BlendFitOptions {
  double position = 1e-7;           ///< model units, over the whole surface: bound (1)
  Radians angle = degrees(1e-4);    ///< at the trimlines
  double curvature = 1e-5;          ///< at G2 trimlines, 1/model unit
  int max_control_points = 200000;  ///< of the whole net
};

struct BlendFitReport {
  double position_bound = 0.0;      ///< (1), with eps_k and eta_k bounded between the samples too
  Radians angle_estimate;           ///< largest sampled at the trimlines, against the exact blend
  double curvature_estimate = 0.0;  ///< the same for the normal curvature across G2 trimlines; 0 without any
  int spans_u = 0, spans_v = 0;
  int control_points = 0;
};

struct BlendFit {
  BSplineSurface surface;  ///< u in [0, 1], v as in the blend; periodic in v when closed
  BlendFitReport report;
};

/// Throws InputError when a tolerance is not positive, GeometryError when a closed blend has a corner at its
/// seam and when a root of the sweep equation exceeds 1e9 (boundary layers thinner than the knots of a STEP
/// file keep), ConvergenceError when max_control_points do not suffice; says what was reached.
[[nodiscard]] BlendFit fit_blend(const OdeBlend& blend, const BlendFitOptions& options,
                                 const Progress& progress = {});

}  // namespace blendwright
