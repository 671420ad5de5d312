#pragma once
// The largest or smallest value of a quadric within a ball (see ball_maximum.hpp):
//   F(X) = max or min of Q(Y), |Y - X| <= D
// Exact, with all derivatives. At points with several maximisers the gradient is that at one of them.
#include "implicit/primitives/quadric.hpp"

namespace blendwright::detail {

struct QuadricBall {
  /// sign: 1 for the largest value, -1 for the smallest.
  QuadricBall(const QuadricCoefficients& coefficients, double radius, double sign);
  Quadric q;  ///< of sign Q
  double radius, sign;
  Eigen::Matrix3d axes;  ///< columns: eigenvectors of the quadratic part of sign Q
  Vec3 bends;            ///< its eigenvalues
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::QuadricBall>();
}  // namespace blendwright
