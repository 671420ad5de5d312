#include "implicit/eval/slots.hpp"

#include <limits>

namespace blendwright::detail {

std::size_t assign_slots(std::span<Tape::Step> steps, std::span<const StepIndex> args,
                         std::vector<StepIndex>& last_use, std::vector<std::uint32_t>& free) {
  constexpr StepIndex never = std::numeric_limits<StepIndex>::max();
  last_use.assign(steps.size(), never);
  free.clear();
  for (StepIndex i = 0; i < steps.size(); ++i)
    for (const StepIndex a : args.subspan(steps[i].first_arg, steps[i].arg_count)) last_use[a] = i;
  std::uint32_t count = 0;
  for (StepIndex i = 0; i < steps.size(); ++i) {
    for (const StepIndex a : args.subspan(steps[i].first_arg, steps[i].arg_count))
      if (last_use[a] == i) {
        last_use[a] = never;  // given back once, also when it is an argument twice
        free.push_back(steps[a].slot);
      }
    if (free.empty()) {
      steps[i].slot = count++;
    } else {
      steps[i].slot = free.back();
      free.pop_back();
    }
  }
  return count;
}

}  // namespace blendwright::detail
