#pragma once
// The zero-level form of Ricci's operators, x = e^g: union(g) = -(1/n) ln sum e^(-n g_i), with the least g
// taken out of the sum; intersection(g) = -union(-g); difference = intersection(g_1, -g_2, ...). n > 0; any
// number of arguments of either sign. Partials: the weights e^(-n g_i) / sum, in [0, 1] with sum 1; Lipschitz
// 1 in the max norm; union in [min - ln k/n, min]. Derived from Ricci 1973. Range: end points.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

/// What a zero-level operator makes of its arguments; signs go in and out of the union's formula.
enum class ZeroRole { make_union, make_intersection, make_difference };
/// The sign that argument i gets, and the result.
[[nodiscard]] constexpr double argument_sign(ZeroRole role, std::size_t i) {
  return role == ZeroRole::make_intersection || (role == ZeroRole::make_difference && i == 0) ? -1.0 : 1.0;
}
[[nodiscard]] constexpr double result_sign(ZeroRole role) {
  return role == ZeroRole::make_union ? 1.0 : -1.0;
}

struct LogSumExp {
  double n = 1.0;
  ZeroRole role = ZeroRole::make_union;
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::LogSumExp>();
}  // namespace blendwright
