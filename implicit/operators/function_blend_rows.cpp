// The rows of Liming's and Rockwood's blends.
#include <array>
#include <cmath>

#include "implicit/operators/function_liming.hpp"
#include "implicit/operators/function_node.hpp"
#include "implicit/operators/function_rockwood.hpp"
#include "implicit/primitives/primitive_inputs.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::detail {
namespace {

using Type = NodeParam::Type;

double value_at(const Node& node, const Vec3& at) {
  TapeBuilder builder;
  const std::shared_ptr<const Tape> tape = builder.finish(node.emit(builder, Frame()));
  double value = 0.0;
  tape->evaluate_scalar(Order::value, {{&at.x(), 1}, {&at.y(), 1}, {&at.z(), 1}}, {&value, 1});
  return value;
}

/// The u of the curve through a point: (1 - u) A B = u P^(n+1) there.
std::optional<double> u_through(NodeInputs& in, const Nodes& of, const Node& blend, int n) {
  const Vec3 at = read_point(in, "through");
  const double product = value_at(*of[0], at) * value_at(*of[1], at);
  const double power = std::pow(value_at(blend, at), n + 1);
  const double u = product / (product + power);
  if (product > 0.0 && power > 0.0 && u > 0.0 && u < 1.0) return u;
  in.problem("through", scene_error::invalid_parameter,
             "is a point with A B = " + number_text(product, 6) + " and P^(n+1) = " + number_text(power, 6) +
                 ", must have both > 0: no blend with 0 < u < 1 goes through it");
  return std::nullopt;
}

std::optional<double> read_u(NodeInputs& in, const Nodes& of, const Node& blend, int n) {
  if (!in.has("through")) return in.number("u");
  if (!in.has("u")) return u_through(in, of, blend, n);
  in.problem("through", scene_error::invalid_parameter,
             "is given together with u, must be given instead of it");
  return std::nullopt;
}

/// The solid L >= 0 also is where A and B are both negative: nothing is known of its bounds.
Node make_liming(NodeInputs& in) {
  Nodes of = function_operands(in, 2);
  const std::shared_ptr<const Node> blend = function_operand(in, "blend");
  if (of.empty() || !blend) return {};
  const int n = static_cast<int>(in.number("order"));
  const std::optional<double> u = read_u(in, of, *blend, n);
  if (!u) return {};
  of.push_back(blend);
  return function_node(of, of_all(Liming{*u, n}), [](double) { return std::nullopt; });
}

/// Where Phi of a union reaches a value, f1 or f2 is positive, or both a < r/c_a and b < r/c_b (the chord P >
/// 0), or c_a c_b a b <= -value/(1 - u), so that one of a and b is at most the root of it.
Region clipped_region(const LimingClipped& b, Nodes of) {
  return [b, of = std::move(of)](double value) -> std::optional<Box> {
    const double wide = 1.0 + 1e-12;
    const double low = std::sqrt(std::max(0.0, -value) / (1.0 - b.u) / b.c_a / b.c_b) * wide;
    const std::optional<Box> all = hull_of(of, -low);
    if (!all) return std::nullopt;
    const std::optional<Box> first = of[0]->region(-b.r / b.c_a * wide),
                             second = of[1]->region(-b.r / b.c_b * wide);
    if (!first && !second) return std::nullopt;
    const std::optional<Box> fillet = first && second ? common(*first, *second) : first ? first : second;
    return fillet ? hull(*all, *fillet) : all;
  };
}

/// Intersection and difference take material away: their values are > 0 inside both only. Where c_a f1 = -x,
/// x > 0, the dual union has P <= x/2 or not; it is at least (1 - u) x^2/2 or u x^2/4.
Reach clipped_reach(const LimingClipped& b) {
  const double least = std::min(0.25 * b.u, 0.5 * (1.0 - b.u)), c = std::min(b.c_a, b.c_b);
  return [=](double value) { return -std::sqrt(std::max(0.0, -value) / least) / c * (1.0 + 1e-12); };
}

Node make_liming_clipped(NodeInputs& in) {
  const Nodes of = function_operands(in, 2);
  const LimingClipped b{read_length(in, "c_a"), read_length(in, "c_b"), read_length(in, "r"), in.number("u"),
                        read_join(in)};
  if (of.empty()) return {};
  Region region = b.join == Join::unite ? clipped_region(b, of) : join_region(b.join, of, clipped_reach(b));
  return function_node(of, of_all(b), std::move(region));
}

/// sum ((1 + f_i/r_i)+)^w >= 1 + value: one of k terms has that share of it.
Region raw_region(const SuperEllipse& shape, Nodes of) {
  return [shape, of = std::move(of)](double value) -> std::optional<Box> {
    const double share = (1.0 + value) / static_cast<double>(of.size());
    if (!(share > 0.0)) return std::nullopt;
    const double x = std::pow(share, 1.0 / shape.w.exponent) * (1.0 - 1e-12) - 1.0;
    std::optional<Box> all;
    for (std::size_t i = 0; i < of.size(); ++i) {
      const std::optional<Box> one = of[i]->region(shape.r[i] * x);
      if (!one) return std::nullopt;
      all = all ? hull(*all, *one) : *one;
    }
    return all;
  };
}

Node make_rockwood_raw(NodeInputs& in) {
  const Nodes of = function_operands(in);
  const std::optional<SuperEllipse> shape = read_super_ellipse(in, in.nodes("of").size());
  if (of.empty() || !shape) return {};
  return function_node(of, of_all(RockwoodRaw{*shape}), raw_region(*shape, of));
}

template <Join J>
Node make_rockwood(NodeInputs& in) {
  const Nodes of = function_operands(in);
  const std::optional<SuperEllipse> shape = read_super_ellipse(in, in.nodes("of").size());
  if (of.empty() || !shape) return {};
  const Combination combine = of_all(Displacement{*shape, J});
  return function_node(of, combine, join_region(J, of, shifted_reach(J, combine, of.size())));
}

constexpr NodeParam u_param{
    .type = Type::number,
    .info = {.name = "u",
             .description = "u, 0 < u < 1: to 0 sharp, to 1 the chord P = 0; of planes at right angles "
                            "1/3 is a circle, 1/5 a parabola",
             .min = 1e-6,
             .max = 1.0 - 1e-6,
             .min_allowed = true,
             .fallback = 1.0 / 3.0}};
constexpr std::array liming_params{
    operands_param("A, B: two nodes of function representation, positive where the blend is"),
    NodeParam{.type = Type::node,
              .info = {.name = "blend", .description = "P: the blend touches A = 0 and B = 0 where P = 0"}},
    u_param,
    NodeParam{.type = Type::point,
              .info = {.name = "through", .description = "a point of the blend, in place of u"},
              .required = false},
    NodeParam{.type = Type::integer,
              .info = {.name = "order",
                       .description = "n: order of the contact, odd preferred; 1 is Liming's",
                       .min = 1.0,
                       .max = 9.0,
                       .min_allowed = true,
                       .fallback = 1.0}}};
constexpr std::array clipped_params{operands_param("f1, f2: two nodes of function representation"),
                                    length_param("c_a", "c_a: the blend touches f2 = 0 where f1 = -r/c_a"),
                                    length_param("c_b", "c_b: the blend touches f1 = 0 where f2 = -r/c_b"),
                                    length_param("r", "r: reach of the blend"),
                                    u_param,
                                    join_param};
constexpr std::array rockwood_params{operands_param("f1, f2, ...: nodes of function representation"),
                                     reaches_param, weight_param};
constexpr NodeFamily operation = NodeFamily::operation;
constexpr std::string_view rockwood = "Rockwood 1989";

constexpr std::array rows{
    NodeKind{"liming", operation, "L = (1 - u) A B - u P^(n+1)",
             "a curve of a pencil that touches two functions; no solid where both are negative",
             "Liming 1944, 1979; Li, Hoschek and Hartmann 1990", liming_params, make_liming},
    NodeKind{"liming_clipped", operation,
             "f = u (P+)^2 - (1 - u) c_a c_b f1 f2, P = r + c_a f1 + c_b f2; no product where f1, f2 > 0",
             "two solids with a conic blend of given reach", "Liming 1944, Vyatkin 2007-2014", clipped_params,
             make_liming_clipped},
    NodeKind{"rockwood_union", operation, "f = -h: sum ((1 + (f_i + h)/r_i)+)^w = 1",
             "union of functions with a super-elliptic fillet of limited reach", rockwood, rockwood_params,
             make_rockwood<Join::unite>},
    NodeKind{"rockwood_intersection", operation, "f = h: sum ((1 - (f_i - h)/r_i)+)^w = 1",
             "intersection of functions with a super-elliptic round of limited reach", rockwood,
             rockwood_params, make_rockwood<Join::intersect>},
    NodeKind{"rockwood_difference", operation, "rockwood_intersection of f1, -f2, ...",
             "the first function's solid without the others, with a super-elliptic round", rockwood,
             rockwood_params, make_rockwood<Join::subtract>},
    NodeKind{"rockwood_raw", operation, "f = sum ((1 + f_i/r_i)+)^w - 1",
             "the same union without displacement: constant far outside, not to be blended again", rockwood,
             rockwood_params, make_rockwood_raw},
};

}  // namespace

std::span<const NodeKind> function_blend_kinds() { return rows; }

}  // namespace blendwright::detail
