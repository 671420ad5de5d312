#include <array>

#include "implicit/operators/operation_rows.hpp"
#include "implicit/operators/sharp.hpp"

namespace blendwright::detail {
namespace {

constexpr std::array soft_params{operands_param("f1, f2, ...: soft objects")};
constexpr std::array sharp_params{operands_param("nodes of one level")};
constexpr std::array complement_params{
    NodeParam{.type = NodeParam::Type::node, .info = {.name = "of", .description = "a node of any level"}}};
constexpr NodeFamily operation = NodeFamily::operation;

template <class Complement>
Node complement_of(const std::shared_ptr<const Node>& of) {
  Node node;
  node.level = of->level;
  node.distance = of->distance;
  node.any_value = of->any_value;
  node.origin = of->origin;
  node.lattice = std::make_shared<const NodeLattice>(NodeLattice{NodeLattice::Kind::complement, {of}});
  node.emit = [of, body = std::make_shared<const Complement>()](TapeBuilder& tape, const Frame& frame) {
    return tape.add<Complement>(body, Frame(), {of->emit(tape, frame)});
  };
  return node;
}

Node make_complement(NodeInputs& in) {
  const std::shared_ptr<const Node> of = in.node("of");
  switch (of->level) {
    case Level::one:
      if (!of->distance)
        in.problem("of", scene_error::level_mismatch,
                   "is of one level, but signed: 1/x is a complement only where x is never negative");
      return complement_of<Reciprocal>(of);
    case Level::half:
      return complement_of<OneMinus>(of);
    case Level::zero:
    case Level::function:
      break;
  }
  return complement_of<Negative>(of);
}

constexpr std::array rows{
    NodeKind{"soft_blend", operation, "f = f1 + f2 + ...", "union of soft objects that flow together",
             "Blinn 1982", soft_params, make_operation_of<OperatorId::soft_blend>},
    NodeKind{"soft_intersection", operation, "f = max(0, f1 + f2 + ... - (k - 1)) of k objects",
             "intersection of soft objects, the dual of soft_blend", "after Blinn 1982", soft_params,
             make_operation_of<OperatorId::soft_intersection>},
    NodeKind{"soft_difference", operation, "f = max(0, f1 - f2 - ...)",
             "the first soft object without the others, the dual of soft_blend", "after Blinn 1982",
             soft_params, make_operation_of<OperatorId::soft_difference>},
    NodeKind{"min", operation, "f = min(f1, f2, ...)",
             "sharp union of levels zero and one, sharp intersection of half level and functions", "Ricci 1973",
             sharp_params, make_operation_of<OperatorId::min>},
    NodeKind{"max", operation, "f = max(f1, f2, ...)",
             "sharp intersection of levels zero and one, sharp union of half level and functions", "Ricci 1973",
             sharp_params, make_operation_of<OperatorId::max>},
    NodeKind{"complement", operation, "-f of functions and level zero, 1/x of level one, 1 - f of half level",
             "everything outside the solid", "Ricci 1973", complement_params, make_complement},
};

}  // namespace

std::span<const NodeKind> soft_kinds() { return rows; }

}  // namespace blendwright::detail
