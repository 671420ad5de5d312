#pragma once
// The rows of operation_kinds(), group by group.
#include "implicit/operators/combination.hpp"
#include "implicit/scene/node.hpp"

namespace blendwright::detail {

/// A node of this operator from its checked values.
[[nodiscard]] Node make_operation(NodeInputs& in, OperatorId id);
template <OperatorId Id>
[[nodiscard]] Node make_operation_of(NodeInputs& in) {
  return make_operation(in, Id);
}

[[nodiscard]] constexpr NodeParam operands_param(std::string_view description) {
  return {.type = NodeParam::Type::nodes, .info = {.name = "of", .description = description}, .count = 2};
}

[[nodiscard]] std::span<const NodeKind> ricci_kinds();
[[nodiscard]] std::span<const NodeKind> zero_kinds();  ///< log-sum-exp and Hoffmann
[[nodiscard]] std::span<const NodeKind> scale_kinds();
[[nodiscard]] std::span<const NodeKind> soft_kinds();  ///< sums, sharp operators, complement

}  // namespace blendwright::detail
