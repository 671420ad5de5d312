// The rows of operations with material added or taken next to one edge, and of blends of one edge.
#include <array>
#include <cmath>

#include "implicit/operators/function_local.hpp"
#include "implicit/operators/function_node.hpp"
#include "implicit/operators/function_rockwood.hpp"
#include "implicit/primitives/primitive_inputs.hpp"
#include "implicit/primitives/quadric.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::detail {
namespace {

using Type = NodeParam::Type;

/// The sum of R_0 of the first two steps and of a body of all steps.
template <class Body>
Combination with_material(Join join, Body body) {
  return [set = r_combination(join, 0.0), material = of_all(std::move(body)), sum = of_all(Sum{})](
             TapeBuilder& tape, std::span<const StepIndex> args) {
    const StepIndex both[] = {set(tape, args.first(2)), material(tape, args)};
    return sum(tape, both);
  };
}

/// a0 of any sign, and a1, a2, ... > 0; false after a problem.
bool check_amounts(NodeInputs& in, std::span<const double> a) {
  bool usable = std::abs(a[0]) <= largest_length;
  if (!usable)
    in.problem(
        "a", scene_error::invalid_parameter,
        "is " + number_text(a[0]) + ", must be at most " + number_text(largest_length) + " in magnitude", 0);
  if (a[0] == 0.0) in.warning("a", "has a0 = 0: nothing is added or taken away");
  for (std::size_t i = 1; i < a.size(); ++i) {
    usable = a[i] >= smallest_length && a[i] <= largest_length && usable;
    static_cast<void>(checked_length(in, "a", a[i], static_cast<int>(i)));
  }
  return usable;
}

/// Of R_0, at the value that is left when all material is taken off.
Region set_region(Join join, const Nodes& of) {
  return join_region(join, of, homogeneous_reach(join, r_combination(join, 0.0), 2));
}

template <Join J>
Node make_pasko_savchenko(NodeInputs& in) {
  const Nodes of = function_operands(in, 2);
  const std::vector<double>& a = in.numbers("a");
  if (!check_amounts(in, a) || of.empty()) return {};
  return function_node(of, with_material(J, EdgeMaterial{a[0], a[1], a[2]}),
                       [region = set_region(J, of), added = std::max(a[0], 0.0)](double value) {
                         return region(value - added * (1.0 + 1e-12));
                       });
}

/// Where `value` is reached, it is without the material, or within the bounds of the material.
Region bounded_region(Region set, std::shared_ptr<const Node> within, double added) {
  return [set = std::move(set), within = std::move(within), added](double value) -> std::optional<Box> {
    const std::optional<Box> plain = set(value);
    if (added == 0.0 || !plain) return plain;
    const std::optional<Box> more = set(value - added * (1.0 + 1e-12)), bounds = within->region(0.0);
    if (!more && !bounds) return std::nullopt;
    const std::optional<Box> part = more && bounds ? common(*more, *bounds) : more ? more : bounds;
    return part ? hull(*plain, *part) : plain;
  };
}

template <Join J>
Node make_bounded_blend(NodeInputs& in) {
  Nodes of = function_operands(in, 2);
  const std::shared_ptr<const Node> within = function_operand(in, "within");
  const std::vector<double>& a = in.numbers("a");
  if (!check_amounts(in, a) || of.empty() || !within) return {};
  Region region = bounded_region(set_region(J, of), within, std::max(a[0], 0.0));
  of.push_back(within);
  return function_node(of, with_material(J, BoundedMaterial{a[0], a[1], a[2], a[3]}), std::move(region));
}

Node make_local_blend(NodeInputs& in) {
  const Nodes of = function_operands(in);
  const std::shared_ptr<const Node> around = function_operand(in, "around");
  const std::optional<SuperEllipse> shape = read_super_ellipse(in, in.nodes("of").size());
  const Cutoff cutoff{read_length(in, "fade")};
  if (of.empty() || !around || !shape) return {};
  const Join join = read_join(in);
  const Combination whole = of_all(Displacement{*shape, join});
  const auto same = [](double value) { return value; };
  Region region = join_region(join, of, same);
  if (join == Join::unite) region = bounded_region(region, around, combined(whole, of.size(), 0.0));
  Nodes all{around};
  all.insert(all.end(), of.begin(), of.end());
  const Combination combine = [fade = of_all(cutoff), blend = of_all(LocalDisplacement{*shape, join})](
                                  TapeBuilder& tape, std::span<const StepIndex> args) {
    std::vector<StepIndex> steps(args.begin(), args.end());
    steps[0] = fade(tape, args.first(1));
    return blend(tape, steps);
  };
  return function_node(std::move(all), combine, std::move(region));
}

constexpr NodeParam two_operands = operands_param("f1, f2: two nodes of function representation");
constexpr std::array edge_params{
    two_operands,
    NodeParam{.type = Type::numbers,
              .info = {.name = "a",
                       .description = "[a0, a1, a2]: a0 > 0 adds, a0 < 0 takes away; a1, a2 > 0: "
                                      "how far, as values of f1 and f2"},
              .count = 3}};
constexpr std::array bounded_params{
    two_operands,
    NodeParam{.type = Type::node,
              .info = {.name = "within", .description = "f3: no effect outside the solid f3 >= 0"}},
    NodeParam{.type = Type::numbers,
              .info = {.name = "a",
                       .description = "[a0, a1, a2, a3]: a0 > 0 adds, a0 < 0 takes away; a1, a2, a3 > 0: how "
                                      "far, as values of f1, f2 and f3"},
              .count = 4}};
constexpr std::array local_params{
    operands_param("f1, f2, ...: nodes of function representation"),
    reaches_param,
    weight_param,
    NodeParam{.type = Type::node,
              .info = {.name = "around", .description = "g: the blend is inside the solid g >= 0 only"}},
    length_param("fade", "value of g from which on the blend has its whole reach"),
    join_param};
constexpr NodeFamily operation = NodeFamily::operation;
constexpr std::string_view savchenko = "Pasko, Adzhiev, Sourin and Savchenko 1995",
                           bounded = "Pasko, Pasko, Ikeda and Kunii 2002";

constexpr std::array rows{
    NodeKind{"pasko_savchenko_union", operation, "f = r_union + a0/(1 + (f1/a1)^2 + (f2/a2)^2)",
             "union of two functions with material added to or taken from the edge", savchenko, edge_params,
             make_pasko_savchenko<Join::unite>},
    NodeKind{"pasko_savchenko_intersection", operation, "f = r_intersection + a0/(1 + (f1/a1)^2 + (f2/a2)^2)",
             "intersection of two functions with material added to or taken from the edge", savchenko,
             edge_params, make_pasko_savchenko<Join::intersect>},
    NodeKind{"pasko_savchenko_difference", operation, "f = r_difference + a0/(1 + (f1/a1)^2 + (f2/a2)^2)",
             "difference of two functions with material added to or taken from the edge", savchenko,
             edge_params, make_pasko_savchenko<Join::subtract>},
    NodeKind{"bounded_blend_union", operation,
             "f = r_union + a0 (1 - q)^3/(1 + q), q = r1/(r1 + r3), r1 = (f1/a1)^2 + (f2/a2)^2, r3 = "
             "(f3/a3)^2",
             "union of two functions, blended inside a third solid only", bounded, bounded_params,
             make_bounded_blend<Join::unite>},
    NodeKind{"bounded_blend_intersection", operation,
             "f = r_intersection + a0 (1 - q)^3/(1 + q), q as of bounded_blend_union",
             "intersection of two functions, blended inside a third solid only", bounded, bounded_params,
             make_bounded_blend<Join::intersect>},
    NodeKind{"bounded_blend_difference", operation,
             "f = r_difference + a0 (1 - q)^3/(1 + q), q as of bounded_blend_union",
             "difference of two functions, blended inside a third solid only", bounded, bounded_params,
             make_bounded_blend<Join::subtract>},
    NodeKind{
        "local_blend", operation,
        "rockwood_union, _intersection or _difference with r_i s(g/fade), s(t) = t^3 (10 - 15 t + 6 t^2)",
        "a super-elliptic blend of one edge; sharp outside the solid around it", "after Rockwood 1989",
        local_params, make_local_blend},
};

}  // namespace

std::span<const NodeKind> function_material_kinds() { return rows; }

}  // namespace blendwright::detail
