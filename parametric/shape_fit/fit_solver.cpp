#include "parametric/shape_fit/fit_solver.hpp"

#include <ceres/cost_function.h>
#include <ceres/iteration_callback.h>
#include <ceres/ordered_groups.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <exception>
#include <utility>

namespace blendwright::detail {
namespace {

/// x as the solver sees it: nonlinear unknowns first, in two blocks.
struct Blocks {
  std::vector<std::size_t> order;  ///< place in x of each entry of the two blocks, one after the other
  std::size_t first = 0;           ///< entries of the first block
  explicit Blocks(const std::vector<bool>& linear) {
    for (const bool want : {false, true}) {
      for (std::size_t p = 0; p < linear.size(); ++p)
        if (linear[p] == want) order.push_back(p);
      if (!want) first = order.size();
    }
  }
  [[nodiscard]] std::size_t second() const { return order.size() - first; }
};

class Cost final : public ceres::CostFunction {
 public:
  Cost(const FitResiduals& residuals, const SolverSetting& setting, const Blocks& blocks,
       std::exception_ptr& error)
      : residuals_(residuals), setting_(setting), blocks_(blocks), error_(error) {
    set_num_residuals(residuals.count());
    for (const std::size_t n : {blocks.first, blocks.second()})
      if (n > 0) mutable_parameter_block_sizes()->push_back(static_cast<int>(n));
  }

  bool Evaluate(const double* const* parameters, double* values, double** jacobians) const override try {
    const std::size_t n = blocks_.order.size();
    std::vector<double> x(n);
    for (std::size_t k = 0; k < n; ++k) {
      const bool in_first = k < blocks_.first || blocks_.first == 0;
      const double* block = in_first ? parameters[0] : parameters[1];
      const std::size_t p = blocks_.order[k];
      x[p] = setting_.scale[p] * block[k - (in_first ? 0 : blocks_.first)];
    }
    RowMatrix J;
    if (!residuals_.evaluate(x.data(), values, jacobians ? &J : nullptr)) return false;
    if (!jacobians) return true;
    const auto rows = static_cast<Eigen::Index>(num_residuals());
    for (std::size_t b = 0; b < parameter_block_sizes().size(); ++b) {
      if (!jacobians[b]) continue;
      const auto columns = static_cast<Eigen::Index>(parameter_block_sizes()[b]);
      Eigen::Map<RowMatrix> part(jacobians[b], rows, columns);
      for (Eigen::Index c = 0; c < columns; ++c) {
        const std::size_t p = blocks_.order[static_cast<std::size_t>(c) + (b == 0 ? 0 : blocks_.first)];
        part.col(c) = setting_.scale[p] * J.col(static_cast<Eigen::Index>(p));
      }
    }
    return true;
  } catch (...) {
    error_ = std::current_exception();
    return false;
  }

 private:
  const FitResiduals& residuals_;
  const SolverSetting& setting_;
  const Blocks& blocks_;
  std::exception_ptr& error_;
};

class Watch final : public ceres::IterationCallback {
 public:
  Watch(const AcceptedStep& accepted, const std::function<std::vector<double>()>& x,
        std::vector<double>& costs, std::exception_ptr& error)
      : accepted_(accepted), x_(x), costs_(costs), error_(error) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override try {
    if (error_) return ceres::SOLVER_ABORT;
    if (summary.iteration > 0 && !summary.step_is_successful) return ceres::SOLVER_CONTINUE;
    costs_.push_back(2.0 * summary.cost);
    if (accepted_) accepted_(static_cast<int>(costs_.size()) - 1, costs_.back(), x_().data());
    return ceres::SOLVER_CONTINUE;
  } catch (...) {
    error_ = std::current_exception();
    return ceres::SOLVER_ABORT;
  }

 private:
  const AcceptedStep& accepted_;
  const std::function<std::vector<double>()>& x_;
  std::vector<double>& costs_;
  std::exception_ptr& error_;
};

}  // namespace

FitSolution solve_fit(const FitResiduals& residuals, const SolverSetting& setting, std::vector<double> x0,
                      const AcceptedStep& accepted) {
  const Blocks blocks(setting.linear);
  std::vector<double> values;
  for (const std::size_t p : blocks.order) values.push_back(x0[p]);
  FitSolution solution;
  std::exception_ptr error;
  const auto gathered = [&](bool scaled) {
    std::vector<double> x(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::size_t p = blocks.order[k];
      x[p] = (scaled ? setting.scale[p] : 1.0) * values[k];
    }
    return x;
  };
  ceres::Problem problem;
  std::vector<double*> parts;
  if (blocks.first > 0) parts.push_back(values.data());
  if (blocks.second() > 0) parts.push_back(values.data() + blocks.first);
  problem.AddResidualBlock(new Cost(residuals, setting, blocks, error), nullptr, parts);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const bool in_first = k < blocks.first;
    double* part = in_first ? values.data() : values.data() + blocks.first;
    const int index = static_cast<int>(in_first ? k : k - blocks.first);
    const Interval& bounds = setting.bounds[blocks.order[k]];
    problem.SetParameterLowerBound(part, index, bounds.lo);
    problem.SetParameterUpperBound(part, index, bounds.hi);
  }
  ceres::Solver::Options options;
  options.num_threads = 1;  // the residuals use the threads; sums keep their order
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = setting.max_iterations;
  options.function_tolerance = 1e-14;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  options.max_solver_time_in_seconds = 1e9;
  options.logging_type = ceres::SILENT;
  options.update_state_every_iteration = true;
  if (blocks.first == 0) options.initial_trust_region_radius = 1e16;
  if (blocks.first > 0 && blocks.second() > 0) {
    options.use_inner_iterations = true;
    options.inner_iteration_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    options.inner_iteration_ordering->AddElementToGroup(values.data() + blocks.first, 0);
  }
  const std::function<std::vector<double>()> state = [&] { return gathered(true); };
  Watch watch(accepted, state, solution.costs, error);
  options.callbacks.push_back(&watch);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (error) std::rethrow_exception(error);
  solution.x = gathered(false);
  solution.usable = summary.IsSolutionUsable();
  solution.converged = summary.termination_type == ceres::CONVERGENCE;
  return solution;
}

}  // namespace blendwright::detail
