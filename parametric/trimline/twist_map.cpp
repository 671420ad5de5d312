#include "parametric/trimline/twist_map.hpp"

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>

#include "kernel/math/quadrature.hpp"
#include "parametric/trimline/line_point.hpp"

namespace blendwright {
namespace {

constexpr int cells = 128;          ///< midpoint rule for (1)
constexpr int spans = 12;           ///< of the spline a
constexpr double smoothing = 1e-4;  ///< weight of g''^2 in (1)
/// (2) does not change when softplus(a) is scaled; this weight holds its mean at 1.
constexpr double scale_weight = 1e-2;

using Row = Eigen::RowVectorXd;

double softplus(double x) { return x > 30.0 ? x : std::log1p(std::exp(x)); }
double softplus_slope(double x) { return 1.0 / (1.0 + std::exp(-x)); }

BSplineBasis density_basis(bool closed) {
  std::vector<double> breaks;
  for (int i = 0; i <= spans; ++i) breaks.push_back(static_cast<double>(i) / spans);
  return closed ? BSplineBasis::closed(3, std::move(breaks)) : BSplineBasis::clamped(3, std::move(breaks));
}

/// The derivative of the unit vector De/|De| along x, and its partials with respect to g and g'.
struct Turn {
  Vec3 rate, by_g, by_slope;
};
Turn turn(const LinePoint& p0, const LinePoint& p1, double slope) {
  const Vec3 D = p1.C - p0.C;
  const double size = D.norm();
  const Vec3 e = D / size;
  const auto across = [&e](const Vec3& x) { return Vec3(x - e * e.dot(x)); };
  const Vec3 Dx = slope * p1.C1 - p0.C1;
  const Vec3 e_g = across(p1.C1) / size;
  Turn t;
  t.rate = across(Dx) / size;
  t.by_g = (across(slope * p1.C2) - e_g * e.dot(Dx) - e * e_g.dot(Dx) - t.rate * e.dot(p1.C1)) / size;
  t.by_slope = e_g;
  return t;
}

/// The residuals of (1): parameters are the coefficients of a, then o when it is free.
class TwistCost final : public ceres::CostFunction {
 public:
  TwistCost(const Trimline& line0, const Trimline& line1, bool free_offset)
      : line1_(line1), closed_(line0.domain().closed), free_offset_(free_offset) {
    const BSplineBasis basis = density_basis(closed_);
    B_ = Eigen::MatrixXd::Zero(cells, basis.count());
    for (int i = 0; i < cells; ++i) {
      const double x = (i + 0.5) / cells;
      const BSplineBasis::Local local = basis.evaluate(x, 0);
      for (int k = 0; k <= 3; ++k)
        B_(i, basis.index(local.first + k)) += local.value[0][static_cast<std::size_t>(k)];
      points0_.push_back(line_point(line0, x));
    }
    set_num_residuals(4 * cells + 1);
    mutable_parameter_block_sizes()->push_back(parameters());
  }

  [[nodiscard]] int parameters() const { return static_cast<int>(B_.cols()) + (free_offset_ ? 1 : 0); }

  bool Evaluate(const double* const* parameters_in, double* residuals, double** jacobians) const override {
    const Eigen::Index n = B_.cols();
    const Eigen::Map<const Eigen::VectorXd> a(parameters_in[0], n);
    const double o = free_offset_ ? parameters_in[0][n] : 0.0;
    const Eigen::VectorXd s = B_ * a;
    const Eigen::VectorXd w = s.unaryExpr([](double x) { return softplus(x); });
    const Eigen::MatrixXd w_a = s.unaryExpr([](double x) { return softplus_slope(x); }).asDiagonal() * B_;
    const double W = w.mean();
    const Row W_a = w_a.colwise().mean();
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    RowMajor J = RowMajor::Zero(num_residuals(), parameters());
    const double root = 1.0 / std::sqrt(static_cast<double>(cells));
    double sum = 0.0;
    Row sum_a = Row::Zero(n);
    for (Eigen::Index i = 0; i < cells; ++i) {
      const double middle = (sum + 0.5 * w[i]) / cells, slope = w[i] / W;
      const Row middle_a = (sum_a + 0.5 * w_a.row(i)) / cells;
      const Row g_a = (middle_a - middle / W * W_a) / W, slope_a = (w_a.row(i) - slope * W_a) / W;
      const Turn t = turn(points0_[static_cast<std::size_t>(i)], line_point(line1_, o + middle / W), slope);
      if (!t.rate.allFinite() || !t.by_g.allFinite()) return false;
      Eigen::Map<Vec3> r(residuals + 3 * i);
      r = root * t.rate;
      J.block(3 * i, 0, 3, n) = root * (t.by_g * g_a + t.by_slope * slope_a);
      if (free_offset_) J.block(3 * i, n, 3, 1) = root * t.by_g;
      sum += w[i];
      sum_a += w_a.row(i);
    }
    smoothness(w, w_a, W, W_a, residuals, J);
    residuals[4 * cells] = scale_weight * (W - 1.0);
    J.block(4 * cells, 0, 1, n) = scale_weight * W_a;
    if (jacobians && jacobians[0]) Eigen::Map<RowMajor>(jacobians[0], J.rows(), J.cols()) = J;
    return true;
  }

 private:
  /// sqrt(smoothing) g'' between neighbouring cells.
  template <class Matrix>
  void smoothness(const Eigen::VectorXd& w, const Eigen::MatrixXd& w_a, double W, const Row& W_a,
                  double* residuals, Matrix& J) const {
    const double weight = std::sqrt(smoothing * cells);
    for (Eigen::Index i = 0; i < cells; ++i) {
      const Eigen::Index next = (i + 1) % cells;
      if (next == 0 && !closed_) {
        residuals[3 * cells + i] = 0.0;
        continue;
      }
      const double step = (w[next] - w[i]) / W;
      residuals[3 * cells + i] = weight * step;
      J.block(3 * cells + i, 0, 1, W_a.size()) = weight / W * (w_a.row(next) - w_a.row(i) - step * W_a);
    }
  }

  Trimline line1_;
  bool closed_, free_offset_;
  Eigen::MatrixXd B_;  ///< cells x coefficients of a
  std::vector<LinePoint> points0_;
};

/// (2) as a quintic spline through 8 nodes per span of a.
FractionMap integrated(const Eigen::VectorXd& a, double offset, bool closed) {
  constexpr int nodes = 8 * spans;
  const BSplineBasis basis = density_basis(closed);
  const auto density = [&](double x) {  // softplus(a) and its derivative
    const BSplineBasis::Local local = basis.evaluate(x, 1);
    double s = 0.0, slope = 0.0;
    for (int k = 0; k <= 3; ++k) {
      const double coefficient = a[basis.index(local.first + k)];
      s += local.value[0][static_cast<std::size_t>(k)] * coefficient;
      slope += local.value[1][static_cast<std::size_t>(k)] * coefficient;
    }
    return std::array<double, 2>{softplus(s), softplus_slope(s) * slope};
  };
  const QuadratureRule& rule = gauss_legendre(6);
  std::vector<double> x{0.0}, g{0.0};
  for (int k = 0; k < nodes; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.x.size(); ++i) sum += rule.w[i] * density((k + rule.x[i]) / nodes)[0];
    x.push_back((k + 1.0) / nodes);
    g.push_back(g.back() + sum / nodes);
  }
  const double W = g.back();
  for (std::size_t k = 0; k < g.size(); ++k) g[k] = g[k] / W - x[k];
  if (closed) {
    g.pop_back();
    return {offset, 1.0, ScalarSpline::closed(std::move(x), g)};
  }
  const auto first = density(0.0), last = density(1.0);
  return {offset, 1.0,
          ScalarSpline::open(std::move(x), g, {first[0] / W - 1.0, first[1] / W},
                             {last[0] / W - 1.0, last[1] / W})};
}

}  // namespace

FractionMap least_twist_map(const Trimline& line0, const Trimline& line1, bool free_offset) {
  auto* cost = new TwistCost(line0, line1, free_offset);  // owned by the problem
  const int count = cost->parameters();
  std::vector<double> x(static_cast<std::size_t>(count),
                        std::log(std::exp(1.0) - 1.0));  // softplus = 1: g(x) = x
  if (free_offset) x.back() = 0.0;
  ceres::Problem problem;
  problem.AddResidualBlock(cost, nullptr, x.data());
  ceres::Solver::Options options;
  options.num_threads = 1;  // the order of summation is part of the result
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-13;
  options.max_solver_time_in_seconds = 1e9;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  const bool better = summary.IsSolutionUsable() &&
                      summary.initial_cost - summary.final_cost > 1e-12 * std::max(1.0, summary.initial_cost);
  if (!better) return {0.0, 1.0, std::nullopt};
  const Eigen::Map<const Eigen::VectorXd> a(x.data(), count - (free_offset ? 1 : 0));
  return integrated(a, free_offset ? x.back() : 0.0, line0.domain().closed);
}

double twist_cost(const Trimline& line0, const Trimline& line1) {
  constexpr int places = 256;
  double sum = 0.0;
  for (int i = 0; i < places; ++i) {
    const double x = (i + 0.5) / places;
    sum += turn(line_point(line0, x), line_point(line1, x), 1.0).rate.squaredNorm() / places;
  }
  return sum;
}

}  // namespace blendwright
