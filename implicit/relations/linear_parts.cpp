#include "implicit/relations/linear_parts.hpp"

#include "implicit/eval/tape_walk.hpp"
#include "implicit/operators/sharp.hpp"

namespace blendwright {
namespace {

constexpr std::size_t most_alternatives = 8, most_bounds = 48;
/// Nodes that are used many times are visited as often: no more than this many.
constexpr int most_visits = 256;

void append(LinearParts& to, std::span<const LinearBound> bounds) {
  to.bounds.insert(to.bounds.end(), bounds.begin(), bounds.end());
}
void close_alternative(LinearParts& to) { to.ends.push_back(static_cast<std::uint32_t>(to.bounds.size())); }

bool small(const LinearParts& parts) {
  return parts.alternatives() <= most_alternatives && parts.bounds.size() <= most_bounds;
}

/// max(a, b): the alternatives of both.
LinearParts larger_of(LinearParts a, const LinearParts& b) {
  for (std::size_t i = 0; i < b.alternatives(); ++i) {
    append(a, b.alternative(i));
    close_alternative(a);
  }
  return a;
}

/// min(a, b): each alternative of one together with each of the other.
LinearParts smaller_of(const LinearParts& a, const LinearParts& b) {
  LinearParts both;
  for (std::size_t i = 0; i < a.alternatives(); ++i) {
    for (std::size_t j = 0; j < b.alternatives(); ++j) {
      append(both, a.alternative(i));
      append(both, b.alternative(j));
      close_alternative(both);
    }
  }
  return both;
}

}  // namespace

/// Goes down from a step through minima, maxima and negatives.
struct Tape::Parts {
  const Tape& tape;
  const Walk& walk;
  int visits = 0;

  LinearParts whole(StepIndex i, double sign) const { return {{sign * walk.linear[i]}, {1}}; }

  LinearParts of(StepIndex index, double sign) {
    const StepIndex i = walk.stand_in[index];
    const Op* op = tape.steps_[i].op;
    if (walk.constant[i] || ++visits > most_visits) return whole(i, sign);
    const auto args = tape.args_of(tape.steps_[i]);
    if (op == &op_for<detail::Negative>()) return of(args[0], -sign);
    const bool minimum = op == &op_for<detail::Minimum>();
    if (!minimum && op != &op_for<detail::Maximum>()) return whole(i, sign);
    LinearParts a = of(args[0], sign);
    const LinearParts b = of(args[1], sign);
    LinearParts both = minimum == (sign > 0.0) ? smaller_of(a, b) : larger_of(std::move(a), b);
    return small(both) ? both : whole(i, sign);
  }
};

LinearParts Tape::linear_parts(const Box& box, double sign) const {
  const Nested<Walk> nested;
  Walk& walk = *nested;
  bound_linearly(box, walk);
  return Parts{*this, walk}.of(static_cast<StepIndex>(steps_.size() - 1), sign);
}

LinearParts linear_parts(const ScalarField::Model& model, const Box& box, double sign) {
  if (const auto* tape = dynamic_cast<const Tape*>(&model)) return tape->linear_parts(box, sign);
  return {{sign * model.linear(box)}, {1}};
}

}  // namespace blendwright
