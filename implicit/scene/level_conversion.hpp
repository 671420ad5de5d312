#pragma once
// From one-level to zero-level fields.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

/// g = x - 1: keeps distances to the surface; needs g > -1 and does not turn the complement 1/x into -g.
struct LevelShift {};

/// g = ln x: turns 1/x into -g and B(x1, ...) into ln B(e^g1, ...). The logarithm is taken of max(x, 1e-100),
/// so that g (-230.3) and its second derivatives are finite where x is next to 0; for smaller x they are 0.
struct LevelLogarithm {};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::LevelShift>();
template <>
const Op& op_for<detail::LevelLogarithm>();
}  // namespace blendwright
