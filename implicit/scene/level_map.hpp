#pragma once
// From any level to any other. With phi = s (n - L), s the sense and L the surface value of a level, a value
// n of one level is n' = L' + s' phi in another.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

/// n' = factor n + shift, factor = 1 or -1.
struct LevelMap {
  double factor = 1.0, shift = 0.0;
};

/// n' = exp(-phi), phi = factor n + shift: level one, always positive, the same zero set. Infinite, with
/// derivatives 0, where -phi > 300; constant where -phi < -700.
struct LevelExponential {
  double factor = 1.0, shift = 0.0;
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::LevelMap>();
template <>
const Op& op_for<detail::LevelExponential>();
}  // namespace blendwright
