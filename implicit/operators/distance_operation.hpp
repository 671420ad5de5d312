#pragma once
// Operations on distances d and T that are ray-linear about one point; so is the result. R = 1/d along a unit
// direction, the radius of d = 1.
//   dilation     (d^-n + T^-n)^(-1/n)         R = (R_d^n + R_T^n)^(1/n)
//   erosion      (d^-n - T^-n)^(-1/n)         R = (R_d^n - R_T^n)^(1/n), where T > d; else infinite: the ray
//   is
//                                             eroded right through
//   ray scaling  d (|X|/T)^n                  R = R_d / R_T^n, n of either sign
// n > 0 for the first two. P.-C. Hsu, Distance Function Operations for Developing New Field Functions, and
// Ray-Scaling Operations for Deformation of Soft Objects, 2016; with the signs of the exponents and r/T
// corrected.
#include "implicit/eval/op.hpp"
#include "implicit/number/power.hpp"

namespace blendwright::detail {

/// Arguments d, T. Rises in both, partials (D/d)^(n+1), (D/T)^(n+1) in [0, 1]. Exactly the smaller where it
/// is 0 or the larger infinite. Range: end points.
struct Dilation {
  Power n, inverse_n;
  explicit Dilation(double exponent) : n(exponent), inverse_n(1.0 / exponent) {}
};

/// Arguments d, T. 0 for d = 0; infinite with derivatives 0 for T <= d, and where E > 1e60 d. Partials
/// (E/d)^(n+1)
/// >= 1, -(E/T)^(n+1). Rises with d, falls with T: range [E(d_lo, T_hi), E(d_hi, T_lo)].
struct Erosion {
  double n = 1.0;
};

/// Arguments d, T; r = |X| of local coordinates. 0 at the origin. The factor (r/T)^n is constant on rays:
/// `factor` bounds it over all directions. Range: d times the factor, which is bounded by r and T of the box
/// and by `factor`.
struct RayScaling {
  bool inverted;  ///< n < 0
  Power n;        ///< |n|
  Range factor;
  RayScaling(double exponent, Range bounds)
      : inverted(exponent < 0.0), n(std::abs(exponent)), factor(bounds) {}
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::Dilation>();
template <>
const Op& op_for<detail::Erosion>();
template <>
const Op& op_for<detail::RayScaling>();
}  // namespace blendwright
