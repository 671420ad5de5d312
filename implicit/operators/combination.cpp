#include "implicit/operators/combination.hpp"

#include <array>

#include "implicit/operators/hoffmann.hpp"
#include "implicit/operators/log_sum_exp.hpp"
#include "implicit/operators/norms.hpp"
#include "implicit/operators/scale_blend.hpp"
#include "implicit/operators/sharp.hpp"
#include "implicit/operators/soft.hpp"

namespace blendwright::detail {
namespace {

using Args = std::span<const StepIndex>;
using enum Joining;

constexpr std::array<Operator, operator_count> rows{{
    {"ricci_union_one", Level::one, unite, OperatorParams::exponent, true},
    {"ricci_intersection_one", Level::one, intersect, OperatorParams::exponent, true},
    {"ricci_difference_one", Level::one, subtract, OperatorParams::exponent, false},
    {"ricci_union_half", Level::half, unite, OperatorParams::exponent, true},
    {"ricci_intersection_half", Level::half, intersect, OperatorParams::exponent, true},
    {"ricci_difference_half", Level::half, subtract, OperatorParams::exponent, false},
    {"lse_union_zero", Level::zero, unite, OperatorParams::exponent, false},
    {"lse_intersection_zero", Level::zero, intersect, OperatorParams::exponent, false},
    {"lse_difference_zero", Level::zero, subtract, OperatorParams::exponent, false},
    {"hoffmann_union_zero", Level::zero, unite, OperatorParams::radii, false},
    {"hoffmann_intersection_zero", Level::zero, intersect, OperatorParams::radii, false},
    {"hoffmann_difference_zero", Level::zero, subtract, OperatorParams::radii, false},
    {"scale_union_one", Level::one, unite, OperatorParams::radii, true},
    {"scale_intersection_one", Level::one, intersect, OperatorParams::radii, true, 1.0},
    {"scale_difference_one", Level::one, subtract, OperatorParams::radii, false, 1.0},
    {"scale_union_half", Level::half, unite, OperatorParams::radii, true, 1.0},
    {"scale_intersection_half", Level::half, intersect, OperatorParams::radii, true, 1.0},
    {"scale_difference_half", Level::half, subtract, OperatorParams::radii, false, 1.0},
    {"soft_blend", Level::half, unite, OperatorParams::none, true},
    {"soft_intersection", Level::half, overlap, OperatorParams::none, false},
    {"soft_difference", Level::half, subtract, OperatorParams::none, false},
    {"min", std::nullopt, unite, OperatorParams::none, true},
    {"max", std::nullopt, intersect, OperatorParams::none, true},
}};

/// max(0, f1 + ... + fk - (k - 1)).
Combination soft_intersection() {
  return [sum = of_two(SoftSum{})](TapeBuilder& tape, Args args) {
    const auto body = std::make_shared<const SoftOverlap>(SoftOverlap{static_cast<double>(args.size() - 1)});
    return tape.add<SoftOverlap>(body, Frame(), {sum(tape, args)});
  };
}
/// max(0, f1 - (f2 + ... + fk)).
Combination soft_difference() {
  return [sum = of_two(SoftSum{}), difference = of_two(SoftDifference{})](TapeBuilder& tape, Args args) {
    const StepIndex both[] = {args[0], sum(tape, args.subspan(1))};
    return difference(tape, both);
  };
}

}  // namespace

const Operator& operator_row(OperatorId id) { return rows[static_cast<std::size_t>(id)]; }

Joining joining(OperatorId id, Level level) {
  const bool upper = sense(level) > 0.0;
  if (id == OperatorId::min) return upper ? intersect : unite;
  if (id == OperatorId::max) return upper ? unite : intersect;
  return operator_row(id).joining;
}

Combination combination(OperatorId id, const OperatorValues& v) {
  const auto scale = [&](ScaleSide side) { return of_two(ScaleBlend(v.r1, v.r2, v.p, side)); };
  const auto hoffmann = [&](ZeroRole role) { return of_two(HoffmannBlend(v.r1, v.r2, v.p, role)); };
  switch (id) {
    // The half level is the upper set: its union is the intersection of level one.
    case OperatorId::ricci_union_one:
    case OperatorId::ricci_intersection_half:
      return of_all(InverseNorm(v.n));
    case OperatorId::ricci_intersection_one:
    case OperatorId::ricci_union_half:
      return of_all(Norm(v.n));
    case OperatorId::ricci_difference_one:
      return with_complements<Reciprocal>(of_all(Norm(v.n)));
    case OperatorId::ricci_difference_half:
      return with_complements<OneMinus>(of_all(InverseNorm(v.n)));
    case OperatorId::lse_union_zero:
      return of_all(LogSumExp{v.n, ZeroRole::make_union});
    case OperatorId::lse_intersection_zero:
      return of_all(LogSumExp{v.n, ZeroRole::make_intersection});
    case OperatorId::lse_difference_zero:
      return of_all(LogSumExp{v.n, ZeroRole::make_difference});
    case OperatorId::hoffmann_union_zero:
      return hoffmann(ZeroRole::make_union);
    case OperatorId::hoffmann_intersection_zero:
      return hoffmann(ZeroRole::make_intersection);
    case OperatorId::hoffmann_difference_zero:
      return hoffmann(ZeroRole::make_difference);
    case OperatorId::scale_union_one:
    case OperatorId::scale_intersection_half:
      return scale(ScaleSide::lower);
    case OperatorId::scale_intersection_one:
    case OperatorId::scale_union_half:
      return scale(ScaleSide::upper);
    case OperatorId::scale_difference_one:
      return with_complements<Reciprocal>(scale(ScaleSide::upper));
    case OperatorId::scale_difference_half:
      return with_complements<OneMinus>(scale(ScaleSide::lower));
    case OperatorId::soft_blend:
      return of_two(SoftSum{});
    case OperatorId::soft_intersection:
      return soft_intersection();
    case OperatorId::soft_difference:
      return soft_difference();
    case OperatorId::min:
      return of_two(Minimum{});
    case OperatorId::max:
      break;
  }
  return of_two(Maximum{});
}

double combined(const Combination& combine, std::size_t count, double value) {
  TapeBuilder builder;
  const std::vector<StepIndex> operands(count, builder.constant(value));
  const std::shared_ptr<const Tape> tape = builder.finish(combine(builder, operands));
  const double at[] = {0.0};
  double result = 0.0;
  tape->evaluate_scalar(Order::value, {at, at, at}, {&result, 1});
  return result;
}

}  // namespace blendwright::detail
