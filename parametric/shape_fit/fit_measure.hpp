#pragma once
// What an objective comes to on a blend as it was made, by the kernel's curvature and not by the fit's own
// formulas. Private to this module.
#include "parametric/shape_fit/shape_fit.hpp"

namespace blendwright::detail {

struct ObjectiveMeasure {
  std::string measure, unit;
  double value = 0.0;
  bool fulfilled = true;
  std::string against{};  ///< when it is not: what is reached and what stands against it
};
/// lengths: of the thin-plate energy's parameters, those of the start.
[[nodiscard]] ObjectiveMeasure measured(const FitObjective& objective, const Blend& blend,
                                        const Vec2& lengths);

}  // namespace blendwright::detail
