#pragma once
// The largest value of a quadratic function on a ball, which is a trust-region problem (More and Sorensen
// 1983), and how it changes when the ball moves:
//   m(w) = g.w + w^T S w, |w| <= D                                                                       (1)
//   (l I - S) w = g/2, l >= max(0, largest eigenvalue of S), l (D - |w|) = 0                             (2)
// With F(X) = f(X + w(X)) the gradient of F is that of f at X + w, and for l > 0, u = w/|w|, M = (l I - S)^-1
//   H_F = 2 l S M - 2 (S M u)(S M u)^T / (u.M u),                                                        (3)
// S being half of the second derivatives of f at X + w. Everything here in coordinates in which S is
// diagonal.
#include "kernel/base/units.hpp"

#include <Eigen/Core>

namespace blendwright::detail {

struct BallMaximum {
  Vec3 w = Vec3::Zero();
  double l = 0.0;            ///< 0: w lies inside, or the gradient vanishes there
  Vec3 gaps = Vec3::Zero();  ///< l - s_i >= 0, without cancellation
  bool tie = false;          ///< -w in some direction is as good: the hard case of (2)
};

/// (2) for S = diag(s) and D > 0.
[[nodiscard]] BallMaximum maximum_on_ball(const Vec3& s, const Vec3& g, double radius);
/// (3); zero for ties and where the maximum lies inside, as F is then constant or has none.
[[nodiscard]] Eigen::Matrix3d moved_hessian(const Vec3& s, const BallMaximum& top);

}  // namespace blendwright::detail
