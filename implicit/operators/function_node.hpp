#pragma once
// What nodes of operators of level function share: checked operands, steps, and how far their solids reach.
#include <memory>
#include <optional>
#include <vector>

#include "implicit/operators/function_join.hpp"
#include "implicit/operators/function_rockwood.hpp"
#include "implicit/operators/operation_rows.hpp"

namespace blendwright::detail {

using Nodes = std::vector<std::shared_ptr<const Node>>;
using Region = std::function<std::optional<Box>(double value)>;

/// Reports a node that is not of level function: operators never convert.
bool is_function(NodeInputs& in, std::string_view key, const Node& node, int index = -1);
/// The operands "of", all of level function; empty after a problem. count: how many there must be, 0 for any.
[[nodiscard]] Nodes function_operands(NodeInputs& in, std::size_t count = 0);
/// The node of a key, of level function; null after a problem.
[[nodiscard]] std::shared_ptr<const Node> function_operand(NodeInputs& in, std::string_view key);

/// The combination of the operands.
[[nodiscard]] Node function_node(Nodes of, Combination combine, Region region);

/// `value` where one operand of a union must have at least that for the union to have `value`; of the other
/// joins that all, or the first, have at least that.
using Reach = std::function<double(double value)>;
[[nodiscard]] Region join_region(Join join, Nodes of, Reach reach);
/// Of R-functions, homogeneous of degree 1: a union of k fields that are all 1 (-1) is `at_one` (`at_minus`).
[[nodiscard]] Reach homogeneous_reach(Join join, const Combination& combine, std::size_t count);
/// Of unions that rise by c when all operands do: by combine(0, ..., 0).
[[nodiscard]] Reach shifted_reach(Join join, const Combination& combine, std::size_t count);

/// R_alpha from left to right; min and max for alpha = 1.
[[nodiscard]] Combination r_combination(Join join, double alpha);
/// Ricci's operators by the exponential adapter n = e^-f: log-sum-exp of all operands.
[[nodiscard]] Combination ricci_function(Join join, double n);

/// The super-ellipse of the keys "r" (one number per operand, or one for all) and "w"; nullopt after a
/// problem.
[[nodiscard]] std::optional<SuperEllipse> read_super_ellipse(NodeInputs& in, std::size_t operands);

inline constexpr NodeParam reaches_param{
    .type = NodeParam::Type::numbers,
    .info = {.name = "r",
             .description = "reach r_i > 0 of the blend, as a value of f_i: one for every operand, "
                            "or one for all"}};
inline constexpr NodeParam weight_param{
    .type = NodeParam::Type::number,
    .info = {.name = "w",
             .description = "thumb weight w >= 1: 1 a chamfer, 2 an elliptic arc, larger nearer to the edge",
             .min = 1.0,
             .max = 1e4,
             .min_allowed = true,
             .fallback = 2.0}};

inline constexpr std::string_view join_words[] = {"union", "intersection", "difference"};
/// The join of the key "join".
[[nodiscard]] inline Join read_join(NodeInputs& in) { return static_cast<Join>(in.word("join")); }
inline constexpr NodeParam join_param{
    .type = NodeParam::Type::word,
    .info = {.name = "join",
             .description = "what becomes of the solids: union (adds material along the edge), "
                            "intersection or difference (take it away)"},
    .required = false,
    .words = join_words};

}  // namespace blendwright::detail
