#pragma once
// The operation that is the same everywhere; its body is the number.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

[[nodiscard]] const Op& constant_op();

}  // namespace blendwright::detail
