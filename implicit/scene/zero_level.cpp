// From level one to level zero, as the papers of soft objects do it.
#include <array>
#include <cmath>

#include "implicit/scene/level_conversion.hpp"
#include "implicit/scene/scene_tables.hpp"

namespace blendwright {
namespace {

using Type = NodeParam::Type;
enum class Form : std::size_t { difference, logarithm };

Node make_zero_level(NodeInputs& in) {
  const std::shared_ptr<const Node> of = in.node("of");
  const Form form{in.word("form")};
  if (of->level != Level::one) {
    in.problem("of", scene_error::level_mismatch,
               "is of " + std::string(name(of->level)) + ", must be of level one (a distance)");
    return {};
  }
  Node node;
  node.level = Level::zero;
  if (form == Form::difference) {
    const auto body = std::make_shared<const detail::LevelShift>();
    node.emit = [of, body](TapeBuilder& tape, const Frame& frame) {
      return tape.add(body, frame, {of->emit(tape, frame)});
    };
    node.region = [of](double value) { return of->region(value + 1.0); };
  } else {
    const auto body = std::make_shared<const detail::LevelLogarithm>();
    node.emit = [of, body](TapeBuilder& tape, const Frame& frame) {
      return tape.add(body, frame, {of->emit(tape, frame)});
    };
    node.region = [of](double value) { return of->region(std::exp(value)); };
  }
  return node;
}

constexpr std::string_view forms[] = {"difference", "logarithm"};
constexpr NodeParam zero_level_params[] = {
    {.type = Type::node, .info = {.name = "of", .description = "x: a node of level one"}},
    {.type = Type::word,
     .info = {.name = "form",
              .description = "difference: g = x - 1, as the papers draw it; logarithm: g = ln x, which also "
                             "turns complements into each other"},
     .required = false,
     .words = forms},
};

constexpr std::array kinds = {
    NodeKind{"zero_level", NodeFamily::conversion, "g = x - 1, or g = ln x",
             "a one-level field as a zero-level one", "Hsu and Lee 2003", zero_level_params, make_zero_level},
};

}  // namespace

std::span<const NodeKind> detail::zero_level_kinds() { return kinds; }

}  // namespace blendwright
