#include "parametric/shape_fit/determination.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/base/number_text.hpp"
#include "kernel/math/dense_solve.hpp"

namespace blendwright::detail {
namespace {

/// R of A = QR by Gram and Schmidt, each column twice: its singular values are those of A to rounding.
Eigen::MatrixXd triangle(Eigen::MatrixXd A) {
  const Eigen::Index n = A.cols();
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (int pass = 0; pass < 2; ++pass)
      for (Eigen::Index i = 0; i < j; ++i) {
        const double c = A.col(i).dot(A.col(j));
        R(i, j) += c;
        A.col(j) -= c * A.col(i);
      }
    R(j, j) = A.col(j).norm();
    if (R(j, j) > 0.0) A.col(j) /= R(j, j);
  }
  return R;
}

/// "a and b", "a, b and c": those that take a real part in the direction, the strongest first.
std::string parts_of(const FitProblem& problem, const Eigen::VectorXd& direction) {
  std::vector<Eigen::Index> order;
  for (Eigen::Index p = 0; p < direction.size(); ++p)
    if (std::abs(direction[p]) > 0.2 * direction.cwiseAbs().maxCoeff()) order.push_back(p);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return std::abs(direction[a]) > std::abs(direction[b]);
  });
  constexpr std::size_t most = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(order.size(), most); ++i) {
    if (i > 0) text += i + 1 == order.size() ? " and " : ", ";
    text += problem.unknowns[static_cast<std::size_t>(order[i])].name;
  }
  if (order.size() > most) text += " and " + std::to_string(order.size() - most) + " more";
  return text + (order.size() > 1 ? " trade off against each other" : " has no effect");
}

}  // namespace

Determination determination(const FitProblem& problem, const FitResiduals& residuals,
                            const std::vector<double>& x, double prior) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Determination d;
  std::vector<double> model_x(x);
  for (std::size_t p = 0; p < x.size(); ++p) model_x[p] *= problem.scale[p];
  Eigen::VectorXd r(residuals.count());
  RowMatrix J;
  if (!residuals.evaluate(model_x.data(), r.data(), &J)) return d;
  const Eigen::Index rows = residuals.objective_rows();
  Eigen::MatrixXd A = J.topRows(rows);
  for (Eigen::Index p = 0; p < n; ++p) A.col(p) *= problem.scale[static_cast<std::size_t>(p)];
  const SingularValues s = singular_values(triangle(std::move(A)));
  const double largest = s.values.size() > 0 ? s.values[0] : 0.0, smallest = n > 0 ? s.values[n - 1] : 0.0;
  d.singular_values.assign(s.values.data(), s.values.data() + n);
  d.condition = smallest > 0.0 ? largest / smallest : std::numeric_limits<double>::infinity();
  const double least = std::max(1e-7 * largest, prior);
  const double freedom = static_cast<double>(std::max<Eigen::Index>(1, rows - n));
  const double variance = r.head(rows).squaredNorm() / freedom;
  d.deviation.assign(x.size(), 0.0);
  std::vector<Eigen::VectorXd> free;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::VectorXd v = s.V.col(k);
    const bool determined = s.values[k] > least;
    for (Eigen::Index p = 0; p < n; ++p) {
      double& deviation = d.deviation[static_cast<std::size_t>(p)];
      if (determined)
        deviation += variance * v[p] * v[p] / (s.values[k] * s.values[k]);
      else if (std::abs(v[p]) > 1e-3)
        deviation = std::numeric_limits<double>::infinity();
    }
    if (determined) continue;
    free.push_back(v);
    d.not_unique.push_back(parts_of(problem, v) + ": not determined by the objectives (singular value " +
                           scientific_text(s.values[k]) + " of " + scientific_text(largest) + ")" +
                           (prior > 0.0 ? "; the pull towards the start decides" : ""));
  }
  for (double& deviation : d.deviation) deviation = std::sqrt(deviation);
  d.free.resize(n, static_cast<Eigen::Index>(free.size()));
  for (std::size_t k = 0; k < free.size(); ++k) d.free.col(static_cast<Eigen::Index>(k)) = free[k];
  return d;
}

}  // namespace blendwright::detail
