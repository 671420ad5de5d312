#pragma once
// The blending operators by name: which steps each is made of, and what it does to solids.
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "implicit/eval/tape.hpp"

namespace blendwright::detail {

/// What an operator does to the solids of its operands. `overlap`: the sum of fields is what counts.
enum class Joining { unite, intersect, subtract, overlap };
enum class OperatorParams { none, exponent, radii };

/// A row per operator. `level`: of operands and result; nullopt: any, the same for all.
struct Operator {
  std::string_view name;
  std::optional<Level> level;
  Joining joining;
  OperatorParams params;
  bool ray_linear;          ///< keeps ray-linearity
  double largest_r = 1e30;  ///< of r1 and r2: 1 where the blend would never reach the operands otherwise
};

enum class OperatorId : std::size_t {
  ricci_union_one,
  ricci_intersection_one,
  ricci_difference_one,
  ricci_union_half,
  ricci_intersection_half,
  ricci_difference_half,
  lse_union_zero,
  lse_intersection_zero,
  lse_difference_zero,
  hoffmann_union_zero,
  hoffmann_intersection_zero,
  hoffmann_difference_zero,
  scale_union_one,
  scale_intersection_one,
  scale_difference_one,
  scale_union_half,
  scale_intersection_half,
  scale_difference_half,
  soft_blend,
  soft_intersection,
  soft_difference,
  min,
  max,
};
inline constexpr std::size_t operator_count = static_cast<std::size_t>(OperatorId::max) + 1;

/// min and max are a union or an intersection depending on the level; their row says what they are for levels
/// zero and one.
[[nodiscard]] const Operator& operator_row(OperatorId id);
[[nodiscard]] Joining joining(OperatorId id, Level level);

struct OperatorValues {
  double n = 1.0, r1 = 1.0, r2 = 1.0, p = 0.0;
};

/// Adds the steps that combine results of earlier ones, at least two. Operators of two arguments are applied
/// from left to right: B(B(f1, f2), f3). The bodies are made once.
using Combination = std::function<StepIndex(TapeBuilder&, std::span<const StepIndex>)>;
[[nodiscard]] Combination combination(OperatorId id, const OperatorValues& values);

/// One operation of all arguments.
template <class Body>
Combination of_all(Body body) {
  return [shared = std::make_shared<const Body>(std::move(body))](TapeBuilder& tape,
                                                                  std::span<const StepIndex> args) {
    return tape.add(op_for<Body>(), shared, Frame(), args);
  };
}

/// An operation of two, from left to right.
template <class Body>
Combination of_two(Body body) {
  return [shared = std::make_shared<const Body>(std::move(body))](TapeBuilder& tape,
                                                                  std::span<const StepIndex> args) {
    StepIndex result = args[0];
    for (const StepIndex next : args.subspan(1)) result = tape.add<Body>(shared, Frame(), {result, next});
    return result;
  };
}

/// All but the first argument go through a complement.
template <class Complement>
Combination with_complements(Combination combine) {
  return [combine = std::move(combine), shared = std::make_shared<const Complement>()](
             TapeBuilder& tape, std::span<const StepIndex> args) {
    std::vector<StepIndex> list{args[0]};
    for (const StepIndex a : args.subspan(1)) list.push_back(tape.add<Complement>(shared, Frame(), {a}));
    return combine(tape, list);
  };
}

/// The combination of `count` operands that are all `value`.
[[nodiscard]] double combined(const Combination& combine, std::size_t count, double value);

}  // namespace blendwright::detail
