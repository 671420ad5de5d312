// From the values of an operation to its node: levels, facts and region.
#include <algorithm>
#include <cmath>

#include "implicit/operators/operation_rows.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::detail {
namespace {

using Nodes = std::vector<std::shared_ptr<const Node>>;

std::string what_it_is(const Node& node) {
  if (node.level == Level::one && !node.distance) return "is of one level, but signed: not a distance";
  if (node.any_value) return "is of half level, but its values may leave [0, 1]";
  return "is of " + std::string(name(node.level));
}

/// Whether an operator with a level of its own can take the values: powers need signs and sizes to be right.
bool in_domain(const Node& node) { return (node.distance || node.level != Level::one) && !node.any_value; }

/// All operands have the level of the operator, or of the first one; those of level one are never negative.
void check_levels(NodeInputs& in, const Operator& row, const Nodes& of) {
  const Level level = row.level.value_or(of.front()->level);
  for (std::size_t i = 0; i < of.size(); ++i) {
    const bool usable = !row.level || in_domain(*of[i]);
    if (of[i]->level == level && usable) continue;
    const std::string required = row.level ? "" : ", as the first operand is";
    in.problem("of", scene_error::level_mismatch,
               what_it_is(*of[i]) + ", must be of " + std::string(name(level)) +
                   (row.level == Level::one ? ", never negative" : required),
               static_cast<int>(i));
  }
}

void check_radius(NodeInputs& in, std::string_view key, double r, const Operator& row) {
  if (r > row.largest_r)
    in.problem(key, scene_error::invalid_parameter,
               "is " + number_text(r) + ", must be <= 1: a blend of this kind does not reach further");
}

OperatorValues read_values(NodeInputs& in, const Operator& row) {
  OperatorValues v;
  if (row.params == OperatorParams::exponent) v.n = in.number("n");
  if (row.params != OperatorParams::radii) return v;
  v.r1 = in.number("r1");
  v.r2 = in.number("r2");
  v.p = in.number("p");
  check_radius(in, "r1", v.r1, row);
  check_radius(in, "r2", v.r2, row);
  const double most = v.r1 * v.r2 * (1.0 - 1e-6);
  if (!(v.p <= most))
    in.problem("p", scene_error::invalid_parameter,
               "is " + number_text(v.p) + ", must be <= r1 r2 (1 - 1e-6) = " + number_text(most) +
                   ": the blend would be a chord");
  return v;
}

/// Where a union reaches `value` one operand reaches this one. Unions of levels one and half are homogeneous
/// and rise: at most value/B(1, ..., 1) is reached by the lowest of level one, at least by the highest of
/// level half. Those of the other levels follow their operands' shifts: value - B(0, ..., 0).
class UnionValue {
 public:
  UnionValue(Level level, const Combination& combine, std::size_t count)
      : scaled_(level == Level::one || level == Level::half),
        at_(combined(combine, count, scaled_ ? 1.0 : 0.0)) {}
  [[nodiscard]] double operator()(double value) const {
    // Rounding is far below what the regions are widened by; the box may only become larger.
    return scaled_ ? value / at_ : value - at_;
  }

 private:
  bool scaled_;
  double at_;
};

std::function<std::optional<Box>(double)> region_of(OperatorId id, Level level, const Combination& combine,
                                                    const Nodes& of) {
  switch (joining(id, level)) {
    case Joining::unite:
      return [of, level, reach = UnionValue(level, combine, of.size())](double value) -> std::optional<Box> {
        if (level == Level::half && !(value > 0.0)) return std::nullopt;
        return hull_of(of, reach(value));
      };
    case Joining::intersect:
      return [of](double value) { return common_of(of, value); };
    case Joining::subtract:
      return [first = of.front()](double value) { return first->region(value); };
    case Joining::overlap:
      break;
  }
  // sum >= value + k - 1: one of the k fields has that share of it.
  return [of](double value) -> std::optional<Box> {
    const auto k = static_cast<double>(of.size());
    return value > 0.0 ? hull_of(of, (value + k - 1.0) / k) : std::nullopt;
  };
}

/// A point of the box as a box: where nothing is.
Box any_point(const Box& box) {
  Vec3 at = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    at[i] = std::isfinite(box.lo[i]) ? box.lo[i] : std::isfinite(box.hi[i]) ? box.hi[i] : 0.0;
  return {at, at};
}

}  // namespace

std::optional<Box> hull_of(std::span<const std::shared_ptr<const Node>> of, double value) {
  std::optional<Box> all;
  for (const auto& node : of) {
    const std::optional<Box> one = node->region(value);
    if (!one) return std::nullopt;
    all = all ? hull(*all, *one) : *one;
  }
  return all;
}

std::optional<Box> common_of(std::span<const std::shared_ptr<const Node>> of, double value) {
  std::optional<Box> all;
  for (const auto& node : of) {
    const std::optional<Box> one = node->region(value);
    if (!one) continue;
    if (!all) {
      all = one;
      continue;
    }
    const std::optional<Box> both = common(*all, *one);
    if (!both) return any_point(*all);
    all = both;
  }
  return all;
}

Node make_operation(NodeInputs& in, OperatorId id) {
  const Operator& row = operator_row(id);
  const Nodes of = in.nodes("of");
  check_levels(in, row, of);
  const OperatorValues values = read_values(in, row);
  const Combination combine = combination(id, values);

  Node node;
  node.level = row.level.value_or(of.front()->level);
  const bool one = node.level == Level::one;
  const auto all = [&](auto holds) {
    return std::ranges::all_of(of, [&](const auto& n) { return holds(*n); });
  };
  node.distance = one && all([](const Node& n) { return n.distance; });
  node.any_value = !all([](const Node& n) { return !n.any_value; });
  node.origin = of.front()->origin;
  // Theorem 2 (Hsu): of ray-linear functions about one point
  node.ray_linear = one && row.ray_linear &&
                    all([&](const Node& n) { return n.ray_linear && same_origin(n, *of.front()); });
  const auto positive = [](const std::shared_ptr<const Node>& n) { return n->positive; };
  node.positive =
      node.ray_linear && (joining(id, node.level) == Joining::unite ? std::ranges::all_of(of, positive)
                                                                    : std::ranges::any_of(of, positive));
  node.emit = [of, combine](TapeBuilder& tape, const Frame& frame) {
    std::vector<StepIndex> steps;
    for (const auto& operand : of) steps.push_back(operand->emit(tape, frame));
    return combine(tape, steps);
  };
  node.region = region_of(id, node.level, combine, of);
  if (id == OperatorId::min || id == OperatorId::max)
    node.lattice = std::make_shared<const NodeLattice>(
        NodeLattice{id == OperatorId::min ? NodeLattice::Kind::smallest : NodeLattice::Kind::largest, of});
  return node;
}

}  // namespace blendwright::detail
