#pragma once
// The surface of a rolling ball's blend, and its edges as boundary data of other blends.
//
// At the ball with centre c and feet p_i = c + r d_i: e_1 = d_1, e_2 = B x d_1, B = d_1 x d_2/|d_1 x d_2|,
// phi = acos(d_1.d_2):
//   X(s, t) = c + r d,  d = cos(t phi) e_1 + sin(t phi) e_2,  t in [0, 1] (1) X_t = r phi (cos(t phi) e_2 -
//   sin(t phi) e_1),  X_s = c' + r d_s with d_i' = -sign(r_i) (dn_i/dc) c'    (2)
// d is normal to the surface, and at t = 0 and 1 to the primaries: G1 along both trimlines.
#include "parametric/cross_tangent/end_condition.hpp"
#include "parametric/rolling_ball/spine.hpp"
#include "parametric/trimline/trimline.hpp"

namespace blendwright {

struct BallSurfacePoint {
  Vec3 X, Xs, Xt;
  Vec3 normal;  ///< d: unit, away from the centre; -sign(r_i) times the outward normal of primary i at its
                ///< foot
};
/// (1) and (2) at the ball that is corrected for s; t outside [0, 1] continues the circle.
[[nodiscard]] BallSurfacePoint ball_surface(const Spine& spine, double s, double t);
/// The same at a ball that was corrected already.
[[nodiscard]] BallSurfacePoint ball_surface(const Spine& spine, const SpinePoint& ball, double t);

/// One edge of the blend as C4 splines over s in [0, length of the spine].
struct BallBoundary {
  Curve3 line;   ///< the foot
  Curve3 cross;  ///< X_t there: from foot 0 towards foot 1; length r phi
  Curve3 bend;  ///< II(X_t, X_t) n of the primary: what a blend with equal curvature has as second derivative
  double deviation = 0.0;  ///< largest distance from balls corrected between the splines' nodes, model units
  /// Boundary data for the sweep blend. G2 continues the primary's curvature.
  [[nodiscard]] EndCondition end(Continuity continuity) const;
};
/// `side` 0 or 1. Nodes are doubled until the deviation is within the tolerance (model units, > 0), to 16384
/// at most; ConvergenceError then.
[[nodiscard]] BallBoundary ball_boundary(const Spine& spine, std::size_t side, double tolerance);

/// The same edge as a trimline of its primary, which must be a surface: on it exactly, and within the
/// tolerance of the ball's feet. GeometryError for a field.
[[nodiscard]] Trimline ball_trimline(const Spine& spine, std::size_t side, double tolerance);

}  // namespace blendwright
