#pragma once
// An operation whose bounds are as wrong as is asked for: what the checks must find.
#include <memory>

#include "implicit/eval/tape.hpp"

namespace blendwright::test {

/// What is too narrow, by one part in 10^9.
enum class Narrow { none, range, rest, slope, shortcut };

/// |X|^2 - 1, with such bounds.
[[nodiscard]] std::shared_ptr<const Tape> narrow_tape(Narrow which);

}  // namespace blendwright::test
