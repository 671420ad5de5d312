#pragma once
// How well the objectives determine the unknowns. Private to this module.
#include "parametric/shape_fit/fit_problem.hpp"
#include "parametric/shape_fit/fit_residuals.hpp"

namespace blendwright::detail {

struct Determination {
  std::vector<double> singular_values;  ///< of the Jacobian without priors, columns in the solver's units
  double condition = 0.0;
  std::vector<double> deviation;  ///< of the solver's x; infinite along directions that are not determined
  std::vector<std::string> not_unique;  ///< one sentence per such direction
  Eigen::MatrixXd free;                 ///< those directions, as columns
};

/// At x (of the solver). A direction is not determined when a whole unit along it changes the residuals by
/// less than 1e-7 of what the best determined one does, or by less than the prior does.
[[nodiscard]] Determination determination(const FitProblem& problem, const FitResiduals& residuals,
                                          const std::vector<double>& x, double prior);

}  // namespace blendwright::detail
