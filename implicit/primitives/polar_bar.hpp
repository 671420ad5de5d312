#pragma once
// A bar along z with a profile as cross-section (implicit spherical product; Hsu 2012, as defined here):
//
//   d = N_n(g(x, y), |z/c|)                                                                               (1)
//
// g: gauge of the profile (profile.hpp); c > 0: half-length of d = 1 (model units); n >= 1; N_n: the
// overflow-safe p-norm. d is ray-linear about the origin. The range tends to the exact one as a box shrinks.
#include "implicit/eval/op.hpp"
#include "implicit/primitives/profile.hpp"

namespace blendwright::detail {

struct PolarBar {
  Profile profile;
  double inverse_c = 1.0;
  Power n, inverse_n;
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::PolarBar>();
}  // namespace blendwright
