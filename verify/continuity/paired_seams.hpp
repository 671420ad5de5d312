#pragma once
// Both seams of one blend, measured side by side.
#include <array>

#include "verify/continuity/seam.hpp"

namespace blendwright::detail {

/// The same reports as check_seam gives for each; cheaper where the blend computes much per v.
[[nodiscard]] std::array<SeamReport, 2> check_paired_seams(const std::array<Seam, 2>& seams,
                                                           const SeamOptions& options,
                                                           const Progress& progress);

}  // namespace blendwright::detail
