// From any level to any other, only where a scene asks for it.
#include <array>
#include <cmath>

#include "implicit/scene/level_map.hpp"
#include "implicit/scene/scene_tables.hpp"

namespace blendwright::detail {
namespace {

using Type = NodeParam::Type;

constexpr std::string_view levels[] = {"zero", "one", "half", "function"};
constexpr std::string_view adapters[] = {"linear", "exponential"};
enum class Adapter : std::size_t { linear, exponential };

/// phi = factor n + shift of a level.
struct Phi {
  double factor, shift;
  explicit Phi(Level level) : factor(sense(level)), shift(-sense(level) * surface_value(level)) {}
};

template <class Body>
std::function<StepIndex(TapeBuilder&, const Frame&)> emit_map(const std::shared_ptr<const Node>& of,
                                                              Body map) {
  return [of, body = std::make_shared<const Body>(map)](TapeBuilder& tape, const Frame& frame) {
    return tape.add<Body>(body, Frame(), {of->emit(tape, frame)});
  };
}

/// n' = L' + s' phi. Of level one it may be negative (where phi > 1), of level half beyond [0, 1]: operators
/// with powers then refuse it.
Node linear(const std::shared_ptr<const Node>& of, Level to) {
  const Phi phi(of->level);
  const double sign = sense(to), at = surface_value(to);
  Node node;
  node.level = to;
  node.any_value = to == Level::half;
  node.emit = emit_map(of, LevelMap{sign * phi.factor, sign * phi.shift + at});
  node.region = [of, to](double value) {
    return of->region(surface_value(of->level) + sense(of->level) * inside(to, value));
  };
  return node;
}

/// n' = exp(-phi) of level one: n' <= v where phi >= -ln v.
Node exponential(const std::shared_ptr<const Node>& of) {
  const Phi phi(of->level);
  Node node;
  node.level = Level::one;
  node.distance = true;
  node.emit = emit_map(of, LevelExponential{phi.factor, phi.shift});
  node.region = [of](double value) -> std::optional<Box> {
    if (!(value > 0.0)) return std::nullopt;
    return of->region(surface_value(of->level) - sense(of->level) * std::log(value));
  };
  return node;
}

Node make_convert(NodeInputs& in) {
  const std::shared_ptr<const Node> of = in.node("of");
  const Level to{static_cast<Level>(in.word("to"))};
  const Adapter adapter{in.word("adapter")};
  if (adapter == Adapter::exponential) {
    if (to == Level::one) return exponential(of);
    in.problem("adapter", scene_error::level_mismatch,
               "is exponential, must be linear unless the node becomes one of level one");
    return {};
  }
  if (of->level == to) {
    Node same = *of;
    in.warning("to", "is the level that the node has already: nothing changes");
    same.detail = nullptr;
    same.emit = [of](TapeBuilder& tape, const Frame& frame) { return of->emit(tape, frame); };
    same.region = [of](double value) { return of->region(value); };
    return same;
  }
  return linear(of, to);
}

constexpr NodeParam convert_params[] = {
    {.type = Type::node, .info = {.name = "of", .description = "n: a node of any level"}},
    {.type = Type::word,
     .info = {.name = "to",
              .description =
                  "the level L', s' that it becomes: zero (n <= 0), one (n <= 1), half (n >= 1/2), "
                  "function (n >= 0)"},
     .words = levels},
    {.type = Type::word,
     .info = {.name = "adapter",
              .description = "linear: n' = L' + s' phi, phi = s (n - L), which may leave the numbers that "
                             "operators with powers take; exponential, to level one: n' = exp(-phi) > 0"},
     .required = false,
     .words = adapters},
};

constexpr std::array rows = {
    NodeKind{"convert", NodeFamily::conversion, "n' = L' + s' s (n - L), or n' = exp(-s (n - L))",
             "a field of one level as one of another", "Vyatkin 2007-2014", convert_params, make_convert},
};

}  // namespace

std::span<const NodeKind> convert_kinds() { return rows; }

}  // namespace blendwright::detail
