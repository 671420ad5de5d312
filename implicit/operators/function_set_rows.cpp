// The rows of set operations of level function: R-functions, and Ricci's by the exponential adapter.
#include <array>
#include <cmath>

#include "implicit/operators/function_node.hpp"
#include "implicit/operators/function_r.hpp"
#include "implicit/primitives/primitive_inputs.hpp"

namespace blendwright::detail {
namespace {

using Type = NodeParam::Type;

template <Join J>
Node make_r(NodeInputs& in) {
  const Nodes of = function_operands(in);
  if (of.empty()) return {};
  const Combination combine = r_combination(J, in.number("alpha"));
  return function_node(of, combine, join_region(J, of, homogeneous_reach(J, combine, of.size())));
}

/// For value < 0: a point with all f_i <= -a has a union of at most -(2 - sqrt 2) a (sqrt 2 a)^m, and one
/// with f_i <= -a an intersection of at most -a^(m+1). For value > 0 the other operand may be of any size, so
/// that only the signs count. Operands below operations have that happen to them once for every one.
Reach r_m_reach(Join join, int m, std::size_t count) {
  return [=](double value) {
    double at = std::min(value, 0.0);
    for (std::size_t i = 1; i < count && at < 0.0; ++i) {
      const double share = join == Join::unite ? (2.0 - std::sqrt(2.0)) * std::pow(2.0, 0.5 * m) : 1.0;
      at = -std::pow(-at / share, 1.0 / (m + 1.0)) * (1.0 + 1e-12);
    }
    return at;
  };
}

template <Join J>
Node make_r_m(NodeInputs& in) {
  const Nodes of = function_operands(in);
  if (of.empty()) return {};
  const int m = static_cast<int>(in.number("m"));
  return function_node(of, of_two(RFunctionM{m, J}), join_region(J, of, r_m_reach(J, m, of.size())));
}

template <Join J>
Node make_ricci(NodeInputs& in) {
  const Nodes of = function_operands(in);
  if (of.empty()) return {};
  const Combination combine = ricci_function(J, in.number("n"));
  return function_node(of, combine, join_region(J, of, shifted_reach(J, combine, of.size())));
}

constexpr NodeParam operands = operands_param("f1, f2, ...: nodes of function representation");
constexpr std::array alpha_params{
    operands, NodeParam{.type = Type::number,
                        .info = {.name = "alpha",
                                 .description = "alpha: 0 the usual one, 1 min and max; applied from left to "
                                                "right",
                                 .min = -1.0,
                                 .max = 1.0,
                                 .fallback = 0.0}}};
constexpr std::array m_params{
    operands,
    NodeParam{.type = Type::integer,
              .info = {.name = "m",
                       .description = "m: the result is C^m where f1 = f2 = 0; applied from left to "
                                      "right",
                       .min = 1.0,
                       .max = 16.0,
                       .min_allowed = true}}};
constexpr std::array exponent_params{
    operands, exponent_param("n", "exponent n, in 1/f: larger is sharper; infinite would be min, max")};
constexpr NodeFamily operation = NodeFamily::operation;
constexpr std::string_view rvachev = "Rvachev 1963, 1982", shapiro = "Rvachev 1982, Shapiro 2007",
                           ricci = "after Ricci 1973";

constexpr std::array rows{
    NodeKind{"r_union", operation, "f = (f1 + f2 + sqrt(f1^2 + f2^2 - 2 alpha f1 f2))/(1 + alpha)",
             "union of functions, smooth but for the edge", rvachev, alpha_params, make_r<Join::unite>},
    NodeKind{"r_intersection", operation, "f = (f1 + f2 - sqrt(f1^2 + f2^2 - 2 alpha f1 f2))/(1 + alpha)",
             "intersection of functions, smooth but for the edge", rvachev, alpha_params,
             make_r<Join::intersect>},
    NodeKind{"r_difference", operation, "r_intersection of f1, -f2, ...",
             "the first function's solid without the others, smooth but for the edge", rvachev, alpha_params,
             make_r<Join::subtract>},
    NodeKind{"r0m_union", operation, "f = (f1 + f2 + sqrt(f1^2 + f2^2)) (f1^2 + f2^2)^(m/2)",
             "union of functions, C^m everywhere", shapiro, m_params, make_r_m<Join::unite>},
    NodeKind{"r0m_intersection", operation, "f = (f1 + f2 - sqrt(f1^2 + f2^2)) (f1^2 + f2^2)^(m/2)",
             "intersection of functions, C^m everywhere", shapiro, m_params, make_r_m<Join::intersect>},
    NodeKind{"r0m_difference", operation, "r0m_intersection of f1, -f2, ...",
             "the first function's solid without the others, C^m everywhere", shapiro, m_params,
             make_r_m<Join::subtract>},
    NodeKind{"ricci_union_function", operation, "f = (1/n) ln(e^(n f1) + e^(n f2) + ...)",
             "union of functions, joints rounded", ricci, exponent_params, make_ricci<Join::unite>},
    NodeKind{"ricci_intersection_function", operation, "f = -(1/n) ln(e^(-n f1) + e^(-n f2) + ...)",
             "intersection of functions, edges rounded", ricci, exponent_params, make_ricci<Join::intersect>},
    NodeKind{"ricci_difference_function", operation, "f = -(1/n) ln(e^(-n f1) + e^(n f2) + ...)",
             "the first function's solid without the others, edges rounded", ricci, exponent_params,
             make_ricci<Join::subtract>},
};

}  // namespace

std::span<const NodeKind> function_set_kinds() { return rows; }

}  // namespace blendwright::detail
