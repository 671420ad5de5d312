#pragma once
// Parallel loops that report and can be stopped on the way.
#include <cstddef>
#include <functional>
#include <string_view>

#include "kernel/base/progress.hpp"

namespace blendwright::detail {

/// Calls body(i) for every i < count, in parallel, and progress between batches, at fractions in [from, to).
/// Results must be written by index.
void for_each_in_batches(std::size_t count, const Progress& progress, double from, double to,
                         std::string_view stage, const std::function<void(std::size_t)>& body);

}  // namespace blendwright::detail
