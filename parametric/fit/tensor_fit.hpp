#pragma once
// Plain tensor interpolation of a blend, for those that are not a sum of products (moving frame).
#include "parametric/fit/blend_fit.hpp"

namespace blendwright::detail {

/// Complete quintic interpolation in u, complete or periodic in v. position_bound: sample_factor^2 times the
/// largest distance on 5 x 5 Chebyshev-Lobatto samples per span, see span_plan.hpp; an estimate beyond
/// leading order.
[[nodiscard]] BlendFit fit_tensor(const OdeBlend& blend, const BlendFitOptions& options,
                                  const Progress& progress);

}  // namespace blendwright::detail
