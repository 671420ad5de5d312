#pragma once
// Tapes whose arguments are the coordinates themselves, so that the derivatives of a field with respect to x,
// y, z are the partial derivatives of an operation.
#include <memory>
#include <vector>

#include "implicit/eval/tape.hpp"
#include "implicit/operators/combination.hpp"

namespace blendwright::test {

/// Coordinate 0, 1 or 2 of the scene.
struct Coordinate {
  int axis = 0;
};

/// The first `count` coordinates as steps.
[[nodiscard]] std::vector<StepIndex> coordinates(TapeBuilder& builder, std::size_t count);

/// An operation of the first `count` coordinates.
template <class Body>
[[nodiscard]] std::shared_ptr<const Tape> op_tape(const Body& body, std::size_t count) {
  TapeBuilder builder;
  const std::vector<StepIndex> args = coordinates(builder, count);
  return builder.finish(builder.add(op_for<Body>(), std::make_shared<const Body>(body), Frame(), args));
}
[[nodiscard]] std::shared_ptr<const Tape> combination_tape(const detail::Combination& combine,
                                                           std::size_t count);

/// Value and first partials at one point, from the vector kernels.
struct Sampled {
  double value;
  Vec3 gradient;
};
[[nodiscard]] Sampled sample(const Tape& tape, const Vec3& at);

}  // namespace blendwright::test

namespace blendwright {
template <>
const Op& op_for<test::Coordinate>();
}  // namespace blendwright
