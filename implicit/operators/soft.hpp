#pragma once
// Sums of soft objects and their duals under 1 - f; half level.
//   soft_blend         f1 + f2 + ...                union; range [0, k]; rises in all
//   soft_intersection  max(0, f1 + f2 + ... - (k - 1))
//   soft_difference    max(0, f1 - f2 - ...)        falls in the subtracted
// The clamps are C0; they act at level 0, below the surface. Blinn 1982; the duals are derived.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

/// f1 + f2. Exactly the other one where one is 0 with derivatives 0.
struct SoftSum {};
/// max(0, f - offset), of a sum f; derivatives 0 where f <= offset.
struct SoftOverlap {
  double offset = 1.0;
};
/// max(0, f1 - f2); exactly f1 where f2 = 0, derivatives 0 where f1 <= f2 otherwise.
struct SoftDifference {};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::SoftSum>();
template <>
const Op& op_for<detail::SoftOverlap>();
template <>
const Op& op_for<detail::SoftDifference>();
}  // namespace blendwright
