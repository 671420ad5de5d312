#include <array>

#include "implicit/operators/operation_rows.hpp"

namespace blendwright::detail {
namespace {

constexpr NodeParam radius(std::string_view name, std::string_view description) {
  return {.type = NodeParam::Type::number,
          .info = {.name = name, .description = description, .min = 1e-9, .max = 1e9, .min_allowed = true}};
}
constexpr std::array<NodeParam, 4> scale_params(std::string_view operands) {
  return {operands_param(operands),
          radius("r1", "r1: the blend leaves the second surface at x1 = (1 +- r1) level"),
          radius("r2", "r2: the blend leaves the first surface at x2 = (1 +- r2) level"),
          NodeParam{.type = NodeParam::Type::number,
                    .info = {.name = "p",
                             .description = "p < r1 r2: 0 an ellipse, -r1 r2 a parabola, r1 r2 the chord",
                             .min = -1e30,
                             .max = 1e30,
                             .min_allowed = true,
                             .fallback = 0.0}}};
}
constexpr auto distances =
    scale_params("x1, x2, ...: distances, joined from left to right: B(B(x1, x2), x3)");
constexpr auto fields =
    scale_params("f1, f2, ...: soft objects, joined from left to right: B(B(f1, f2), f3)");
constexpr NodeFamily operation = NodeFamily::operation;
constexpr std::string_view source = "Hsu and Lee 2003";

constexpr std::array rows{
    NodeKind{"scale_union_one", operation, "x = h: B_H(x1/h - 1, x2/h - 1) = 0; min beyond its range",
             "union of distances with a fillet of limited range; the order of operands matters", source,
             distances, make_operation_of<OperatorId::scale_union_one>},
    NodeKind{"scale_intersection_one", operation,
             "x = h: B_H(1 - x1/h, 1 - x2/h) = 0; max beyond its range; r <= 1",
             "intersection of distances with a round of limited range; the order of operands matters", source,
             distances, make_operation_of<OperatorId::scale_intersection_one>},
    NodeKind{"scale_difference_one", operation, "x = scale_intersection_one(x1, 1/x2, ...); r <= 1",
             "the first distance without the others, with a round of limited range", source, distances,
             make_operation_of<OperatorId::scale_difference_one>},
    NodeKind{"scale_union_half", operation,
             "f = h: B_H(1 - f1/h, 1 - f2/h) = 0; max beyond its range; r <= 1",
             "union of soft objects, blended where f_i >= (1 - r_i)/2; the order of operands matters", source,
             fields, make_operation_of<OperatorId::scale_union_half>},
    NodeKind{"scale_intersection_half", operation,
             "f = h: B_H(f1/h - 1, f2/h - 1) = 0; min beyond its range; r <= 1",
             "intersection of soft objects, blended where f_i <= (1 + r_i)/2; the order of operands matters",
             source, fields, make_operation_of<OperatorId::scale_intersection_half>},
    NodeKind{"scale_difference_half", operation, "f = scale_intersection_half(f1, 1 - f2, ...); r <= 1",
             "the first soft object without the others, with a round of limited range", source, fields,
             make_operation_of<OperatorId::scale_difference_half>},
};

}  // namespace

std::span<const NodeKind> scale_kinds() { return rows; }

}  // namespace blendwright::detail
