#include <array>

#include "implicit/operators/operation_rows.hpp"
#include "implicit/primitives/primitive_inputs.hpp"

namespace blendwright::detail {
namespace {

constexpr std::array exponent_params{
    operands_param("g1, g2, ...: zero-level fields"),
    exponent_param("n", "exponent n: larger is sharper; infinite would be min, max")};
constexpr NodeParam zero_radius(std::string_view name, std::string_view description) {
  return {.type = NodeParam::Type::number,
          .info = {.name = name, .description = description, .min = 1e-9, .max = 1e9, .min_allowed = true}};
}
constexpr std::array radii_params{
    operands_param("x1, x2, ...: zero-level fields, joined from left to right"),
    zero_radius("r1", "r1: how far the blend reaches on the second solid, as a value of x1"),
    zero_radius("r2", "r2: how far the blend reaches on the first solid, as a value of x2"),
    NodeParam{.type = NodeParam::Type::number,
              .info = {.name = "p",
                       .description = "p < r1 r2: 0 an ellipse, -r1 r2 a parabola, r1 r2 the chord",
                       .min = -1e30,
                       .max = 1e30,
                       .min_allowed = true,
                       .fallback = 0.0}}};
constexpr NodeFamily operation = NodeFamily::operation;
constexpr std::string_view ricci = "after Ricci 1973", hoffmann = "Hoffmann and Hopcroft 1985, Rockwood 1989";

constexpr std::array rows{
    NodeKind{"lse_union_zero", operation, "g = -(1/n) ln(e^(-n g1) + e^(-n g2) + ...)",
             "union of zero-level fields, joints rounded", ricci, exponent_params,
             make_operation_of<OperatorId::lse_union_zero>},
    NodeKind{"lse_intersection_zero", operation, "g = (1/n) ln(e^(n g1) + e^(n g2) + ...)",
             "intersection of zero-level fields, edges rounded", ricci, exponent_params,
             make_operation_of<OperatorId::lse_intersection_zero>},
    NodeKind{"lse_difference_zero", operation, "g = (1/n) ln(e^(n g1) + e^(-n g2) + ...)",
             "the first zero-level field without all others", ricci, exponent_params,
             make_operation_of<OperatorId::lse_difference_zero>},
    NodeKind{"hoffmann_union_zero", operation, "x = h: B_H(x1 - h, x2 - h) = 0; min where |x1 - x2| >= r",
             "union of zero-level fields with a conic fillet of limited range", hoffmann, radii_params,
             make_operation_of<OperatorId::hoffmann_union_zero>},
    NodeKind{"hoffmann_intersection_zero", operation,
             "x = h: B_H(h - x1, h - x2) = 0; max where |x1 - x2| >= r",
             "intersection of zero-level fields with a conic round of limited range", hoffmann, radii_params,
             make_operation_of<OperatorId::hoffmann_intersection_zero>},
    NodeKind{"hoffmann_difference_zero", operation, "x = h: B_H(h - x1, h + x2) = 0; max(x1, -x2) beyond",
             "the first zero-level field without the others, with a conic round", hoffmann, radii_params,
             make_operation_of<OperatorId::hoffmann_difference_zero>},
};

}  // namespace

std::span<const NodeKind> zero_kinds() { return rows; }

}  // namespace blendwright::detail
