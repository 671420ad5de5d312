#pragma once
// Which step keeps its results where.
#include <span>
#include <vector>

#include "implicit/eval/tape.hpp"

namespace blendwright::detail {

/// Gives every step a slot such that no result is overwritten before its last use; a step may write over an
/// argument that is not needed after it. The result of the last step stays. Returns the number of slots.
std::size_t assign_slots(std::span<Tape::Step> steps, std::span<const StepIndex> args,
                         std::vector<StepIndex>& last_use, std::vector<std::uint32_t>& free);

}  // namespace blendwright::detail
