#pragma once
// Private: residuals of points to a model, and their least squares.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "implicit/fit/fit_model.hpp"

namespace blendwright::detail {

/// Residuals (2), (3) of scene_fit.hpp at all points, model units.
[[nodiscard]] std::vector<double> residuals(const FitModel& model, std::span<const double> values,
                                            std::span<const Vec3> points);

/// The same with derivatives by the solver's unknowns, one per free slot: the value's logarithm, or itself.
struct Linearised {
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
};
[[nodiscard]] Linearised linearised(const FitModel& model, std::span<const double> values,
                                    std::span<const Vec3> points);

struct SolveOptions {
  /// One run with each, from wide to narrow: outliers lose their pull step by step. 0: plain squares.
  std::vector<double> robust_scales{0.0};
  int max_iterations = 200;
};
struct Solved {
  std::vector<double> values;  ///< of all slots
  double cost = 0.0;           ///< half of (1); infinite when nothing could be evaluated
  bool converged = false;
  std::vector<double> costs;
};
/// Throws Cancelled.
[[nodiscard]] Solved solve_fit(const FitModel& model, std::vector<double> start, std::span<const Vec3> points,
                               const SolveOptions& options, const Progress& progress);

}  // namespace blendwright::detail
