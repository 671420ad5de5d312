#include <array>

#include "implicit/operators/operation_rows.hpp"
#include "implicit/primitives/primitive_inputs.hpp"

namespace blendwright::detail {
namespace {

constexpr std::array distances{
    operands_param("x1, x2, ...: distances"),
    exponent_param("n", "exponent n: larger is sharper; infinite would be min, max")};
constexpr std::array fields{operands_param("f1, f2, ...: soft objects"),
                            exponent_param("n", "exponent n: larger is sharper; infinite would be min, max")};
constexpr NodeFamily operation = NodeFamily::operation;
constexpr std::string_view source = "Ricci 1973";

constexpr std::array rows{
    NodeKind{"ricci_union_one", operation, "x = (x1^-n + x2^-n + ...)^(-1/n)",
             "union of distances, joints rounded", source, distances,
             make_operation_of<OperatorId::ricci_union_one>},
    NodeKind{"ricci_intersection_one", operation, "x = (x1^n + x2^n + ...)^(1/n)",
             "intersection of distances, edges rounded", source, distances,
             make_operation_of<OperatorId::ricci_intersection_one>},
    NodeKind{"ricci_difference_one", operation, "x = (x1^n + x2^-n + ...)^(1/n)",
             "the first distance without all others, edges rounded", source, distances,
             make_operation_of<OperatorId::ricci_difference_one>},
    NodeKind{"ricci_union_half", operation, "f = (f1^n + f2^n + ...)^(1/n)", "union of soft objects", source,
             fields, make_operation_of<OperatorId::ricci_union_half>},
    NodeKind{"ricci_intersection_half", operation, "f = (f1^-n + f2^-n + ...)^(-1/n)",
             "intersection of soft objects", source, fields,
             make_operation_of<OperatorId::ricci_intersection_half>},
    NodeKind{"ricci_difference_half", operation, "f = (f1^-n + (1 - f2)^-n + ...)^(-1/n)",
             "the first soft object without all others", source, fields,
             make_operation_of<OperatorId::ricci_difference_half>},
};

}  // namespace

std::span<const NodeKind> ricci_kinds() { return rows; }

}  // namespace blendwright::detail
