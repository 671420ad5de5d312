#pragma once
// The offset along the normal (Vyatkin 2007-2014), a field of its own that probes another one:
//   F(X) = f(Y), Y = X + D N, N = g/|g|, g = grad f(X)                                                    (1)
//   grad F = g(Y) + (D/|g|) H (I - N N^T) g(Y), H = Hess f(X)                                             (2)
// N is a unit vector (errata: the source calls it "the gradient vector"; D would not be a length then). The
// normal is taken at X, not at the foot point on the surface, so F = 0 is the offset surface only where the
// lines of steepest ascent are straight (f a function of a distance); else it is off by O(D^2).
//   Degenerate: |g| <= g_min, N has no direction: F = f(X).
//   Overshoot: where D is more than the local thickness, the probe leaves the solid on its far side and F is
//   negative between the surface and its offset: a cavity that is not in the solid. A ball of the radius 0.2
//   with D = 1: F = -0.21 at |X| = 0.5.
//   Where f has edges, only faces move; F is one order less smooth than f.
// The second derivatives need third ones of f, along one direction: central differences of fourth order of
// Hess f over 1e-3 |D| take their place. They are exact up to O(D^5) of fifth derivatives, and one-sided
// where f is less smooth.
#include <memory>

#include "implicit/eval/tape.hpp"

namespace blendwright::detail {

struct NormalOffset {
  std::shared_ptr<const Tape> field;
  double distance;  ///< along the gradient of the native value
};
/// Below this (value per length) a gradient has no direction.
inline constexpr double least_gradient = 1e-12;

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::NormalOffset>();
}  // namespace blendwright
