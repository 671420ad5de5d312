#pragma once
// Sharp operators of every level, and complements. Ranges exact.
//   min, max     the winner as it is, the first argument on ties
//   complement   -g of levels zero and function, 1/x of level one, 1 - f of half level
// The half level is the upper set, so max is its union; for levels zero and one min is.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

/// Of two arguments.
struct Minimum {};
struct Maximum {};

struct Negative {};
/// 1/x, x >= 0; infinite with derivatives 0 for x <= 1e-60.
struct Reciprocal {};
struct OneMinus {};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::Minimum>();
template <>
const Op& op_for<detail::Maximum>();
template <>
const Op& op_for<detail::Negative>();
template <>
const Op& op_for<detail::Reciprocal>();
template <>
const Op& op_for<detail::OneMinus>();
}  // namespace blendwright
