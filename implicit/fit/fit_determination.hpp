#pragma once
// Private: how well the points determine the numbers.
#include <string>
#include <vector>

#include "implicit/fit/fit_solver.hpp"

namespace blendwright::detail {

struct Determination {
  std::vector<double> deviation;  ///< per free slot, of the solver's unknown; infinite: not determined at all
  std::vector<bool> determined;   ///< the deviation is below half of a length or exponent, 20 degrees, a
                                  ///< quarter of the points' size
  double condition = 0.0;
};
/// Deviations from s^2 (J^T J)^-1, s: robust standard deviation of the residuals. `size`: of the points.
[[nodiscard]] Determination determination(const FitModel& model, const Linearised& at, double noise,
                                          double size);

}  // namespace blendwright::detail
