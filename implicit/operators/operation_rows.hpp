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

/// The hull of all regions: a point where the value is reached lies in one of them.
[[nodiscard]] std::optional<Box> hull_of(std::span<const std::shared_ptr<const Node>> of, double value);
/// What all regions have in common; those that are not known do not restrict it. When it is empty it is a
/// point.
[[nodiscard]] std::optional<Box> common_of(std::span<const std::shared_ptr<const Node>> of, double value);

[[nodiscard]] std::span<const NodeKind> ricci_kinds();
[[nodiscard]] std::span<const NodeKind> zero_kinds();  ///< log-sum-exp and Hoffmann
[[nodiscard]] std::span<const NodeKind> scale_kinds();
[[nodiscard]] std::span<const NodeKind> soft_kinds();               ///< sums, sharp operators, complement
[[nodiscard]] std::span<const NodeKind> function_set_kinds();       ///< level function: R-functions, Ricci
[[nodiscard]] std::span<const NodeKind> function_blend_kinds();     ///< level function: Liming, Rockwood
[[nodiscard]] std::span<const NodeKind> function_material_kinds();  ///< level function: next to an edge

}  // namespace blendwright::detail
