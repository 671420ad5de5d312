#include "implicit/operators/function_node.hpp"

#include <algorithm>
#include <cmath>

#include "implicit/operators/function_r.hpp"
#include "implicit/operators/log_sum_exp.hpp"
#include "implicit/operators/sharp.hpp"
#include "implicit/primitives/primitive_inputs.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::detail {

bool is_function(NodeInputs& in, std::string_view key, const Node& node, int index) {
  if (node.level == Level::function) return true;
  in.problem(key, scene_error::level_mismatch,
             "is of " + std::string(name(node.level)) + ", must be of " + std::string(name(Level::function)) +
                 ": put it into a node of kind \"convert\"",
             index);
  return false;
}

Nodes function_operands(NodeInputs& in, std::size_t count) {
  Nodes of = in.nodes("of");
  bool usable = true;
  for (std::size_t i = 0; i < of.size(); ++i)
    usable = is_function(in, "of", *of[i], static_cast<int>(i)) && usable;
  if (count != 0 && of.size() != count) {
    in.problem("of", scene_error::invalid_parameter,
               "is a list of " + std::to_string(of.size()) + " nodes, must be a list of " +
                   std::to_string(count) + "; for more, make this node an operand of another one");
    usable = false;
  }
  return usable ? of : Nodes{};
}

std::shared_ptr<const Node> function_operand(NodeInputs& in, std::string_view key) {
  std::shared_ptr<const Node> node = in.node(key);
  return is_function(in, key, *node) ? node : nullptr;
}

Node function_node(Nodes of, Combination combine, Region region) {
  Node node;
  node.level = Level::function;
  node.emit = [of = std::move(of), combine = std::move(combine)](TapeBuilder& tape, const Frame& frame) {
    std::vector<StepIndex> steps;
    for (const auto& operand : of) steps.push_back(operand->emit(tape, frame));
    return combine(tape, steps);
  };
  node.region = std::move(region);
  return node;
}

Region join_region(Join join, Nodes of, Reach reach) {
  switch (join) {
    case Join::unite:
      return
          [of = std::move(of), reach = std::move(reach)](double value) { return hull_of(of, reach(value)); };
    case Join::intersect:
      return [of = std::move(of), reach = std::move(reach)](double value) {
        return common_of(of, reach(value));
      };
    case Join::subtract:
      break;
  }
  return [first = of.front(), reach = std::move(reach)](double value) { return first->region(reach(value)); };
}

Reach homogeneous_reach(Join join, const Combination& combine, std::size_t count) {
  // Intersections and differences are at most their operands.
  if (join != Join::unite) return [](double value) { return value; };
  const double at_one = combined(combine, count, 1.0), at_minus = -combined(combine, count, -1.0);
  // Rounding is far below the part added here.
  return
      [=](double value) { return value / (value > 0.0 ? at_one : at_minus) - range_slack * std::abs(value); };
}

Reach shifted_reach(Join join, const Combination& combine, std::size_t count) {
  if (join != Join::unite) return [](double value) { return value; };
  return [at = combined(combine, count, 0.0)](double value) {
    return value - at - range_slack * (std::abs(value) + at);
  };
}

Combination r_combination(Join join, double alpha) {
  if (alpha < 1.0) return of_two(RFunction{alpha, join});
  if (join == Join::unite) return of_two(Maximum{});
  return join == Join::intersect ? of_two(Minimum{}) : with_complements<Negative>(of_two(Minimum{}));
}

Combination ricci_function(Join join, double n) {
  // The zero level is the lower set: its union is the intersection here.
  if (join == Join::unite) return of_all(LogSumExp{n, ZeroRole::make_intersection});
  Combination lower = of_all(LogSumExp{n, ZeroRole::make_union});
  return join == Join::intersect ? lower : with_complements<Negative>(std::move(lower));
}

std::optional<SuperEllipse> read_super_ellipse(NodeInputs& in, std::size_t operands) {
  std::vector<double> r = in.numbers("r");
  bool usable = true;
  for (std::size_t i = 0; i < r.size(); ++i) {
    usable = r[i] >= smallest_length && r[i] <= largest_length && usable;
    static_cast<void>(checked_length(in, "r", r[i], static_cast<int>(i)));
  }
  if (r.size() != 1 && r.size() != operands) {
    in.problem("r", scene_error::invalid_parameter,
               "is a list of " + std::to_string(r.size()) + " numbers, must be one number for each of the " +
                   std::to_string(operands) + " operands, or one for all");
    usable = false;
  }
  if (!usable) return std::nullopt;
  r.resize(operands, r.front());
  return SuperEllipse(std::move(r), in.number("w"));
}

}  // namespace blendwright::detail
