// The rows of quadrics, perturbation functions and freeforms.
#include <algorithm>
#include <array>

#include "implicit/primitives/primitive_inputs.hpp"
#include "implicit/primitives/primitive_tables.hpp"
#include "implicit/primitives/quadric.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::detail {
namespace {

using Type = NodeParam::Type;

/// Coefficients and lengths are bounded so that values, derivatives and their products stay numbers.
constexpr double largest_coefficient = 1e60;

Node quadric_node(const QuadricCoefficients& a) {
  Node node;
  node.level = Level::function;
  node.emit = emit_body(Quadric{a});
  node.region = [a](double value) { return quadric_region(a, value); };
  node.quadric = std::make_shared<const NodeQuadric>(NodeQuadric{a, {}});
  return node;
}

Node make_quadric(NodeInputs& in) {
  const std::vector<double>& given = in.numbers("coefficients");
  QuadricCoefficients a{};
  for (std::size_t i = 0; i < 10; ++i) {
    a[i] = given[i];
    if (std::abs(a[i]) <= largest_coefficient) continue;
    in.problem(
        "coefficients", scene_error::invalid_parameter,
        "is " + number_text(a[i]) + ", must be at most " + number_text(largest_coefficient) + " in magnitude",
        static_cast<int>(i));
    return {};
  }
  if (std::all_of(a.begin(), a.end(), [](double x) { return x == 0.0; })) {
    in.problem("coefficients", scene_error::invalid_parameter, "are all 0, must not be: that has no surface");
    return {};
  }
  if (std::all_of(a.begin(), a.end() - 1, [](double x) { return x == 0.0; }))
    in.warning("coefficients", "has only the free term: the same value everywhere, and no surface");
  return quadric_node(a);
}

Node make_ellipsoid_quadric(NodeInputs& in) {
  QuadricCoefficients a{};
  constexpr std::string_view keys[] = {"a", "b", "c"};
  for (std::size_t i = 0; i < 3; ++i) {
    const double s = read_length(in, keys[i]);
    a[i] = -1.0 / (s * s);
  }
  a[9] = 1.0;
  return quadric_node(a);
}

/// Reports a node that is not of level function.
bool is_function(NodeInputs& in, std::string_view key, const Node& node, int index = -1) {
  if (node.level == Level::function) return true;
  in.problem(key, scene_error::level_mismatch,
             "is of " + std::string(name(node.level)) + ", must be of " + std::string(name(Level::function)) +
                 "; convert it",
             index);
  return false;
}

/// The q at which R = w (q + c)^k takes a value > 0 of the sign of w.
double argument_at(const Perturbation& b, double value) {
  return std::pow(value / b.weight, 1.0 / b.power) - b.free_term;
}

void warn_of_support(NodeInputs& in, const Node& q, double free_term) {
  const std::optional<QuadricTop> top = q.quadric ? top_of(q.quadric->coefficients) : std::nullopt;
  if (top && !(top->value + free_term > 0.0))
    in.warning("of", "is " + number_text(top->value, 4) +
                         " at most, which with the free term is not > 0: the support is empty, and the "
                         "perturbation is 0 everywhere");
  else if (const std::optional<Box> support = q.region(-free_term); !support || !support->finite())
    in.warning("of",
               "has an unbounded support (or one without a known bound): boxes far away cannot leave "
               "the perturbation out");
}

Node make_perturbation(NodeInputs& in) {
  const std::shared_ptr<const Node> of = in.node("of");
  const Perturbation b{in.number("weight"), static_cast<int>(in.number("power")), in.number("free_term")};
  if (!is_function(in, "of", *of)) return {};
  if (b.weight == 0.0) {
    in.problem("weight", scene_error::invalid_parameter, "is 0, must be > 0 (a bump) or < 0 (a dent)");
    return {};
  }
  warn_of_support(in, *of, b.free_term);
  Node node;
  node.level = Level::function;
  node.weight = b.weight;
  node.perturbs = std::make_shared<const NodePerturbation>(NodePerturbation{of, b.power, b.free_term});
  const auto body = std::make_shared<const Perturbation>(b);
  node.emit = [of, body](TapeBuilder& tape, const Frame& frame) {
    return tape.add(body, Frame(), {of->emit(tape, frame)});
  };
  node.region = [of, b](double value) -> std::optional<Box> {
    if (b.weight > 0.0 && value > 0.0) return of->region(argument_at(b, value));
    return std::nullopt;
  };
  return node;
}

using Nodes = std::vector<std::shared_ptr<const Node>>;

/// Where the sum reaches `value`, either the base does, or a bump is larger than 0 there; dents only take
/// away.
std::optional<Box> freeform_region(const Node* base, const Nodes& bumps, double value) {
  std::optional<Box> all;
  if (base)
    all = base->region(value);
  else if (!(value > 0.0))
    return std::nullopt;
  if (base && !all) return std::nullopt;
  for (const auto& bump : bumps) {
    if (bump->weight < 0.0) continue;
    const std::optional<Box> support = bump->region(std::numeric_limits<double>::denorm_min());
    if (!support) return std::nullopt;
    all = all ? hull(*all, *support) : *support;
  }
  return all;
}

/// Adds the steps that add a bump to the sum so far.
using Adding = std::function<StepIndex(TapeBuilder&, const Frame&, StepIndex)>;

/// One step for the perturbation by a quadric, which is what freeforms are made of; else two or three.
Adding adding_of(const std::shared_ptr<const Node>& bump) {
  if (!bump->perturbs)
    return
        [bump, sum = std::make_shared<const Sum>()](TapeBuilder& tape, const Frame& frame, StepIndex total) {
          return tape.add(sum, Frame(), {total, bump->emit(tape, frame)});
        };
  const std::shared_ptr<const Node> q = bump->perturbs->q;
  const Perturbation p{bump->weight, bump->perturbs->power, bump->perturbs->free_term};
  if (!q->quadric)
    return [q, body = std::make_shared<const AddedPerturbation>(AddedPerturbation{p})](
               TapeBuilder& tape, const Frame& frame, StepIndex total) {
      return tape.add(body, Frame(), {total, q->emit(tape, frame)});
    };
  return [body = std::make_shared<const AddedQuadric>(AddedQuadric{Quadric(q->quadric->coefficients), p}),
          inner = q->quadric->frame](TapeBuilder& tape, const Frame& frame, StepIndex total) {
    return tape.add(body, inner.after(frame), {total});
  };
}

bool check_parts(NodeInputs& in, const Node* base, const Nodes& bumps) {
  bool good = true;
  if (base) good = is_function(in, "base", *base);
  if (!base && bumps.empty()) {
    in.problem("base", "", "is missing, must be there when there are no bumps");
    good = false;
  }
  for (std::size_t i = 0; i < bumps.size(); ++i) {
    if (bumps[i]->weight != 0.0) continue;
    in.problem("bumps", scene_error::invalid_parameter, "is no perturbation, must be one",
               static_cast<int>(i));
    good = false;
  }
  return good;
}

Node make_freeform(NodeInputs& in) {
  const std::shared_ptr<const Node> base = in.node("base");
  const Nodes bumps = in.nodes("bumps");
  if (!check_parts(in, base.get(), bumps)) return {};
  Node node;
  node.level = Level::function;
  std::vector<Adding> adding;
  for (const auto& bump : bumps) adding.push_back(adding_of(bump));
  node.emit = [base, bumps, adding](TapeBuilder& tape, const Frame& frame) {
    StepIndex total = base ? base->emit(tape, frame) : bumps.front()->emit(tape, frame);
    for (std::size_t i = base ? 0 : 1; i < adding.size(); ++i) total = adding[i](tape, frame, total);
    return total;
  };
  node.region = [base, bumps](double value) { return freeform_region(base.get(), bumps, value); };
  return node;
}

constexpr double any_number = -std::numeric_limits<double>::max();

constexpr std::array quadric_params{
    NodeParam{.type = Type::numbers,
              .info = {.name = "coefficients",
                       .description = "[A11, A22, A33, A12, A13, A23, A14, A24, A34, A44]; cross and linear "
                                      "terms are whole, without a hidden factor 2"},
              .count = 10}};
constexpr std::array ellipsoid_quadric_params{length_param("a", "semi-axis along x"),
                                              length_param("b", "semi-axis along y"),
                                              length_param("c", "semi-axis along z")};
constexpr std::array perturbation_params{
    NodeParam{.type = Type::node,
              .info = {.name = "of", .description = "q: a node of level function; the support is q >= 0"}},
    NodeParam{.type = Type::number,
              .info = {.name = "weight",
                       .description = "w: > 0 adds material (a bump), < 0 removes it (a dent)",
                       .min = -1e30,
                       .max = 1e30,
                       .min_allowed = true,
                       .fallback = 1.0}},
    NodeParam{.type = Type::integer,
              .info = {.name = "power",
                       .description = "k: smoothness across the support's border is C^(k-1)",
                       .min = 2.0,
                       .max = 16.0,
                       .min_allowed = true,
                       .fallback = 3.0}},
    NodeParam{.type = Type::number,
              .info = {.name = "free_term",
                       .description = "c: grows (> 0) or shrinks support and height of this perturbation; no "
                                      "offset of the solid",
                       .min = any_number,
                       .min_allowed = true,
                       .fallback = 0.0}}};
constexpr std::array freeform_params{
    NodeParam{.type = Type::node,
              .info = {.name = "base", .description = "F: any node of level function; 0 if not given"},
              .required = false},
    NodeParam{.type = Type::nodes,
              .info = {.name = "bumps", .description = "R_i: perturbations, also placed ones"},
              .required = false,
              .count = 1}};

constexpr std::array rows{
    NodeKind{"quadric", NodeFamily::solid,
             "f = A11 x^2 + A22 y^2 + A33 z^2 + A12 xy + A13 xz + A23 yz + A14 x + A24 y + A34 z + A44",
             "a quadric, f >= 0 inside", "Vyatkin 2007-2014", quadric_params, make_quadric},
    NodeKind{"ellipsoid_quadric", NodeFamily::solid, "f = 1 - (x/a)^2 - (y/b)^2 - (z/c)^2",
             "an ellipsoid as a quadric", "Vyatkin 2007-2014", ellipsoid_quadric_params,
             make_ellipsoid_quadric},
    NodeKind{"perturbation", NodeFamily::solid, "R = w max(q + c, 0)^k",
             "what a freeform adds: 0 outside its support", "Vyatkin 2007-2014", perturbation_params,
             make_perturbation},
    NodeKind{"freeform", NodeFamily::solid, "f = F + sum R_i", "a solid with bumps and dents",
             "Vyatkin 2007-2014", freeform_params, make_freeform}};

}  // namespace

std::span<const NodeKind> quadric_kinds() { return rows; }

}  // namespace blendwright::detail
