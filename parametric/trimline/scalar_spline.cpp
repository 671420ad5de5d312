#include "parametric/trimline/scalar_spline.hpp"

#include <algorithm>

#include "kernel/geometry/spline_interpolation.hpp"

namespace blendwright {
namespace {

std::vector<double> to_vector(const Eigen::MatrixXd& control) {
  return {control.data(), control.data() + control.rows()};
}

Eigen::MatrixXd column(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// First and second derivative at x of the polynomial through (t_i, f_i): Newton's divided differences on a
/// series.
std::array<double, 2> end_derivatives(double x, const std::vector<double>& t, std::vector<double> f) {
  const std::size_t n = t.size();
  for (std::size_t level = 1; level < n; ++level)
    for (std::size_t i = n - 1; i >= level; --i) f[i] = (f[i] - f[i - 1]) / (t[i] - t[i - level]);
  const Series h = Series::variable(x);
  Series p(f[n - 1]);
  for (std::size_t i = n - 1; i-- > 0;) p = p * (h - t[i]) + f[i];
  return {p.derivative(1), p.derivative(2)};
}

}  // namespace

ScalarSpline ScalarSpline::closed(std::vector<double> breaks, const std::vector<double>& values) {
  BSplineBasis basis = BSplineBasis::closed(degree, std::move(breaks));
  std::vector<double> control = to_vector(periodic_control(basis, column(values)));
  return ScalarSpline(std::move(basis), std::move(control));
}

ScalarSpline ScalarSpline::open(std::vector<double> breaks, const std::vector<double>& values,
                                std::array<double, 2> start, std::array<double, 2> end) {
  BSplineBasis basis = BSplineBasis::clamped(degree, std::move(breaks));
  const Eigen::MatrixXd s = Eigen::Map<const Eigen::VectorXd>(start.data(), 2);
  const Eigen::MatrixXd e = Eigen::Map<const Eigen::VectorXd>(end.data(), 2);
  std::vector<double> control = to_vector(complete_control(basis, column(values), s, e));
  return ScalarSpline(std::move(basis), std::move(control));
}

ScalarSpline ScalarSpline::open(std::vector<double> breaks, const std::vector<double>& values) {
  const auto n = static_cast<std::ptrdiff_t>(std::min<std::size_t>(5, breaks.size()));
  const auto start = end_derivatives(breaks.front(), {breaks.begin(), breaks.begin() + n},
                                     {values.begin(), values.begin() + n});
  const auto end =
      end_derivatives(breaks.back(), {breaks.end() - n, breaks.end()}, {values.end() - n, values.end()});
  return open(std::move(breaks), values, start, end);
}

double ScalarSpline::operator()(double t) const {
  const BSplineBasis::Local local = basis_.evaluate(t, 0);
  double sum = 0.0;
  for (int i = 0; i <= degree; ++i)
    sum += local.value[0][static_cast<std::size_t>(i)] *
           control_[static_cast<std::size_t>(basis_.index(local.first + i))];
  return sum;
}

Series ScalarSpline::operator()(const Series& t) const {
  const BSplineBasis::Local local = basis_.evaluate(t.value(), Series::order);
  std::array<double, Series::order + 1> f{};
  double factorial = 1.0;
  for (std::size_t k = 0; k < f.size(); ++k) {
    if (k > 0) factorial *= static_cast<double>(k);
    for (int i = 0; i <= degree; ++i)
      f[k] += local.value[k][static_cast<std::size_t>(i)] *
              control_[static_cast<std::size_t>(basis_.index(local.first + i))];
    f[k] /= factorial;
  }
  return compose_scalar(f, t);
}

}  // namespace blendwright
