#pragma once
// The offset by a ball, of any field: the largest (smallest) value within the radius D (see ball_search.hpp).
#include "implicit/eval/tape.hpp"

namespace blendwright::detail {

struct BallOffset {
  std::shared_ptr<const Tape> field;
  double radius, sign;  ///< sign: 1 for the largest native value, -1 for the smallest
  double tolerance;
};

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::BallOffset>();
}  // namespace blendwright
