#include "implicit/fit/fit_solver.hpp"

#include <ceres/dynamic_autodiff_cost_function.h>
#include <ceres/iteration_callback.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <limits>

#include "implicit/fit/fit_formula.hpp"
#include "implicit/fit/fit_space.hpp"
#include "kernel/base/error.hpp"

namespace blendwright::detail {
namespace {

using Scale = FitSlot::Scale;

/// Residual at one point: (2) or (3) of scene_fit.hpp. In the flat foot of a field and at its top the
/// first-order distance means nothing: there the ray to the nearest member is taken.
template <class T>
T residual(const FitModel& model, const T* values, const Vec3& point) {
  using std::sqrt;
  const std::size_t solid = model.nodes.size() - 1;
  const T zero(0.0), one(1.0);
  const std::vector<Spatial<T>> numbers(values, values + model.slots.size());
  const Point<Spatial<T>> X{Spatial<T>(T(point.x()), {one, zero, zero}),
                            Spatial<T>(T(point.y()), {zero, one, zero}),
                            Spatial<T>(T(point.z()), {zero, zero, one})};
  const FitEvaluation<Spatial<T>> evaluation(model, numbers.data());
  const auto slope = [](const Spatial<T>& f) {
    const T square = f.g[0] * f.g[0] + f.g[1] * f.g[1] + f.g[2] * f.g[2];
    return square > T(0.0) ? T(sqrt(square)) : T(0.0);
  };
  if (!model.blend) {
    const Reached<Spatial<T>> at = evaluation.distance(solid, X);
    const T steep = slope(at.d);
    return steep > T(0.0) ? (at.d.v - T(1.0)) / steep : -at.ray.v;
  }
  Spatial<T> nearest(std::numeric_limits<double>::max());
  const Spatial<T> f = evaluation.field(solid, X, nearest);
  const T steep = slope(f);
  if (f.v > T(0.02) && f.v < T(2.0) && steep > T(0.0)) {
    const T distance = (T(0.5) - f.v) / steep;
    if (magnitude(distance) < magnitude(nearest.v) * 10.0) return distance;
  }
  return nearest.v;
}

double to_solver(const FitSlot& slot, double value) {
  return slot.scale == Scale::logarithmic ? std::log(value) : value;
}

/// As Ceres wants it: the residual of one point as a function of the free unknowns.
struct PointResidual {
  const FitModel* model;
  const std::vector<std::size_t>* free;
  const std::vector<double>* fixed;
  Vec3 point;
  template <class T>
  bool operator()(T const* const* unknowns, T* out) const {
    using std::exp;
    constexpr std::size_t most = 24;  // of a single form with its placement; more need the heap
    std::array<T, most> few;
    std::vector<T> many;
    if (fixed->size() > most) many.resize(fixed->size());
    T* values = many.empty() ? few.data() : many.data();
    for (std::size_t i = 0; i < fixed->size(); ++i) values[i] = T((*fixed)[i]);
    for (std::size_t k = 0; k < free->size(); ++k) {
      const T& x = unknowns[0][k];
      values[(*free)[k]] = model->slots[(*free)[k]].scale == Scale::logarithmic ? T(exp(x)) : x;
    }
    out[0] = residual(*model, values, point);
    return true;
  }
};

using PointCost = ceres::DynamicAutoDiffCostFunction<PointResidual, 4>;

std::unique_ptr<PointCost> point_cost(const PointResidual& r) {
  auto cost = std::make_unique<PointCost>(new PointResidual(r));
  cost->AddParameterBlock(static_cast<int>(r.free->size()));
  cost->SetNumResiduals(1);
  return cost;
}

class Stop final : public ceres::IterationCallback {
 public:
  explicit Stop(const Progress& progress) : progress_(progress) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    costs.push_back(summary.cost);
    return progress_.stop.stop_requested() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }
  std::vector<double> costs;

 private:
  const Progress& progress_;
};

}  // namespace

std::vector<double> residuals(const FitModel& model, std::span<const double> values,
                              std::span<const Vec3> points) {
  std::vector<double> r(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) r[i] = residual(model, values.data(), points[i]);
  return r;
}

Linearised linearised(const FitModel& model, std::span<const double> values, std::span<const Vec3> points) {
  const std::vector<double> fixed(values.begin(), values.end());
  const std::vector<std::size_t> free = model.free();
  std::vector<double> x;
  for (const std::size_t i : free) x.push_back(to_solver(model.slots[i], values[i]));
  Linearised out{
      Eigen::VectorXd(static_cast<Eigen::Index>(points.size())),
      Eigen::MatrixXd(static_cast<Eigen::Index>(points.size()), static_cast<Eigen::Index>(free.size()))};
  std::vector<double> row(free.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto cost = point_cost({&model, &free, &fixed, points[i]});
    const double* parameters = x.data();
    double* jacobian = row.data();
    const auto k = static_cast<Eigen::Index>(i);
    cost->Evaluate(&parameters, &out.r[k], &jacobian);
    out.J.row(k) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), out.J.cols());
  }
  return out;
}

Solved solve_fit(const FitModel& model, std::vector<double> start, std::span<const Vec3> points,
                 const SolveOptions& options, const Progress& progress) {
  const std::vector<std::size_t> free = model.free();
  const std::vector<double> fixed = start;
  std::vector<double> x;
  for (const std::size_t i : free)
    x.push_back(
        to_solver(model.slots[i], std::clamp(start[i], model.slots[i].bounds.lo, model.slots[i].bounds.hi)));
  ceres::Problem::Options plain;
  plain.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(plain);
  ceres::LossFunctionWrapper loss(nullptr, ceres::TAKE_OWNERSHIP);
  for (const Vec3& point : points)
    problem.AddResidualBlock(point_cost({&model, &free, &fixed, point}).release(), &loss, x.data());
  for (std::size_t k = 0; k < free.size(); ++k) {
    const FitSlot& slot = model.slots[free[k]];
    if (slot.scale == Scale::turn) continue;
    const int i = static_cast<int>(k);
    if (std::isfinite(slot.bounds.lo))
      problem.SetParameterLowerBound(x.data(), i, to_solver(slot, slot.bounds.lo));
    if (std::isfinite(slot.bounds.hi))
      problem.SetParameterUpperBound(x.data(), i, to_solver(slot, slot.bounds.hi));
  }
  Solved solved{std::move(start), std::numeric_limits<double>::infinity(), false, {}};
  for (const double scale : options.robust_scales) {
    if (scale > 0.0) loss.Reset(new ceres::CauchyLoss(scale), ceres::TAKE_OWNERSHIP);
    Stop stop(progress);
    ceres::Solver::Options how;
    how.linear_solver_type = ceres::DENSE_QR;
    how.max_num_iterations = options.max_iterations;
    how.function_tolerance = 1e-12;
    how.gradient_tolerance = 1e-14;
    how.parameter_tolerance = 1e-11;
    how.logging_type = ceres::SILENT;
    how.num_threads = 1;  // sums in one order: the same bits everywhere
    how.callbacks.push_back(&stop);
    ceres::Solver::Summary summary;
    ceres::Solve(how, &problem, &summary);
    if (progress.stop.stop_requested()) throw Cancelled("stopped while fitting");
    if (!summary.IsSolutionUsable()) break;
    for (std::size_t k = 0; k < free.size(); ++k)
      solved.values[free[k]] = model.slots[free[k]].scale == Scale::logarithmic ? std::exp(x[k]) : x[k];
    solved.cost = summary.final_cost;
    solved.converged = summary.termination_type == ceres::CONVERGENCE;
    solved.costs = std::move(stop.costs);
  }
  return solved;
}

}  // namespace blendwright::detail
