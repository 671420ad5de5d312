#pragma once
// Round bars: the distance to a segment, and its ray-linear substitute.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

/// d = r/I, r = |X - p0 - s e| the distance from the segment p0 p1, e its unit direction, s = clamp((X -
/// p0).e, 0, |p1 - p0|). I > 0: influential radius, where d = 1 (model units); X in R^3, p0 = p1 allowed.
/// Gradient (X - p0 - s e)/(r I), 0 on the segment, where it does not exist; C1 elsewhere; convex; not
/// ray-linear but when p0 = p1. Bloomenthal and Wyvill 1990. Range exact: nearest and farthest point of the
/// box (the function is convex, so a corner).
struct SegmentSkeleton {
  Vec3 start;      ///< p0
  Vec3 direction;  ///< e; 0 for p0 = p1
  double length;   ///< |p1 - p0|
  double inverse_radius;
};

/// The t >= 0 for which X lies on the surface of t K, K the capsule of radius R > 0 around the segment of the
/// z axis from -l0 to l1 (l0, l1 >= 0; model units). With rho^2 = x^2 + y^2, l the end on the side of z:
///   t = rho/R                                                        if R |z| <= l rho (barrel)
///   t = (rho^2 + z^2) / (l |z| + sqrt(R^2 rho^2 + R^2 z^2 - l^2 rho^2))       otherwise (cap)
/// which is the stable root of (R^2 - l^2) t^2 + 2 l |z| t - (rho^2 + z^2) = 0, for every sign of R^2 - l^2;
/// the difference R^2 z^2 - l^2 rho^2 is positive on the cap. Ray-linear, convex, C1 off the origin.
/// Derived (the ray-linear substitute of the segment's distance). Range exact: t rises with rho and with |z|
/// on either side, so the nearest point of the box is the one nearest to 0 in each coordinate.
struct CapsuleGauge {
  double below, above;  ///< l0/R, l1/R
  double inverse_radius;
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::SegmentSkeleton>();
template <>
const Op& op_for<detail::CapsuleGauge>();
}  // namespace blendwright
