#pragma once
// Nonlinear least squares with bounds. Private to this module; Ceres stays in the .cpp.
#include <functional>

#include "parametric/shape_fit/fit_residuals.hpp"

namespace blendwright::detail {

struct FitSolution {
  std::vector<double> x;      ///< of the solver
  std::vector<double> costs;  ///< sum of squares after each accepted step, the start first
  bool converged = false;
  bool usable = false;  ///< a finite cost was found
};

/// Called after each accepted step; may throw, which ends the solve.
using AcceptedStep = std::function<void(int iteration, double cost, const double* x)>;

struct SolverSetting {
  std::vector<double> scale;     ///< x of the residuals = scale * x of the solver
  std::vector<Interval> bounds;  ///< of the solver's x
  std::vector<bool> linear;      ///< unknowns that every residual is linear in
  int max_iterations = 60;
};

/// Levenberg and Marquardt in a box. When all unknowns are linear, a Gauss-Newton step is the solution and is
/// taken whole; when some are, they are eliminated in every step (variable projection, as inner iterations).
/// Steps that `residuals` refuses are shortened. Errors thrown while evaluating are rethrown.
[[nodiscard]] FitSolution solve_fit(const FitResiduals& residuals, const SolverSetting& setting,
                                    std::vector<double> x0, const AcceptedStep& accepted);

}  // namespace blendwright::detail
