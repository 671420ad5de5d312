#include "kernel/geometry/spline_interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/base/error.hpp"
#include "kernel/math/dense_solve.hpp"

namespace blendwright {
namespace {

using Eigen::Index;
constexpr int highest_degree = 9;  // complete ends need derivatives up to (degree - 1)/2 <= 4

void check_basis(const BSplineBasis& basis, bool periodic) {
  const int p = basis.degree();
  if (basis.periodic() != periodic)
    throw InputError("basis", periodic ? "is clamped, must be periodic" : "is periodic, must be clamped");
  if (p % 2 == 0 || p > highest_degree)
    throw InputError("basis/degree", "is " + std::to_string(p) +
                                         ", must be odd and at most 9 for interpolation at the breaks");
  const std::vector<int>& m = basis.multiplicities();
  const std::ptrdiff_t skip = periodic ? 0 : 1;
  if (std::any_of(m.begin() + skip, m.end() - skip, [](int k) { return k != 1; }))
    throw InputError("basis/multiplicities", "must be 1 for interpolation at the breaks");
}

void check_rows(const char* where, Index rows, Index needed) {
  if (rows != needed)
    throw InputError(where, "has " + std::to_string(rows) + " rows, must have " + std::to_string(needed));
}

// weights(k, i): the k-th derivative at x0 of the polynomial through (x_i, f_i) is sum_i weights(k, i) f_i
// (Fornberg 1988, Generation of finite difference formulas on arbitrarily spaced grids).
Eigen::MatrixXd derivative_weights(double x0, const std::vector<double>& x, int order) {
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(order + 1, static_cast<Index>(x.size()));
  w(0, 0) = 1.0;
  double before = 1.0;
  for (std::size_t n = 1; n < x.size(); ++n) {
    const auto N = static_cast<Index>(n);
    double product = 1.0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto I = static_cast<Index>(i);
      const double gap = x[n] - x[i];
      product *= gap;
      if (i + 1 == n)
        for (int k = order; k >= 0; --k)
          w(k, N) = before / product * ((k > 0 ? k * w(k - 1, I) : 0.0) - (x[n - 1] - x0) * w(k, I));
      for (int k = order; k >= 0; --k)
        w(k, I) = ((x[n] - x0) * w(k, I) - (k > 0 ? k * w(k - 1, I) : 0.0)) / gap;
    }
    before = product;
  }
  return w;
}

// Derivatives of orders 1..h at the first or last parameter.
Eigen::MatrixXd end_derivatives(const Eigen::MatrixXd& values, const std::vector<double>& t, int degree,
                                bool last) {
  const Index used = degree + 1, first = last ? values.rows() - used : 0;
  const std::vector<double> x(t.begin() + first, t.begin() + first + used);
  const Eigen::MatrixXd w = derivative_weights(last ? t.back() : t.front(), x, (degree - 1) / 2);
  return w.bottomRows(w.rows() - 1).lazyProduct(values.middleRows(first, used));
}

template <int Dim>
void check_neighbours(const std::vector<Eigen::Matrix<double, Dim, 1>>& points, bool closed) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string where = "points/" + std::to_string(i);
    if (!points[i].allFinite()) throw InputError(where, "has a coordinate that is not finite");
    const bool wraps = i + 1 == points.size();
    if (wraps && !closed) break;
    if (points[i] == points[wraps ? 0 : i + 1])
      throw InputError(where, wraps ? "repeats the first point; of a closed curve it must not be given twice"
                                    : "is equal to the next point, neighbours must differ");
  }
}

}  // namespace

Eigen::MatrixXd periodic_control(const BSplineBasis& basis, const Eigen::Ref<const Eigen::MatrixXd>& values) {
  check_basis(basis, true);
  const int n = basis.count(), p = basis.degree(), h = (p - 1) / 2;
  check_rows("values", values.rows(), n);
  if (n < p + 1)
    throw GeometryError("a periodic spline of degree " + std::to_string(p) + " needs at least " +
                        std::to_string(p + 1) + " points, got " + std::to_string(n));
  Eigen::MatrixXd bands(n, p);
  for (int j = 0; j < n; ++j) {
    // At break j the functions j..j+p-1 do not vanish; unknown i is control i + h, which puts the largest on
    // the diagonal.
    const BSplineBasis::Local N = basis.evaluate(basis.breaks()[static_cast<std::size_t>(j)], 0);
    for (int r = 0; r < p; ++r) bands(j, r) = N.value[0][static_cast<std::size_t>(r)];
  }
  const Eigen::MatrixXd x = solve_banded(bands, h, true, values);
  Eigen::MatrixXd control(n, values.cols());
  control.bottomRows(n - h) = x.topRows(n - h);
  control.topRows(h) = x.bottomRows(h);
  return control;
}

Eigen::MatrixXd complete_control(const BSplineBasis& basis, const Eigen::Ref<const Eigen::MatrixXd>& values,
                                 const Eigen::Ref<const Eigen::MatrixXd>& start,
                                 const Eigen::Ref<const Eigen::MatrixXd>& end) {
  check_basis(basis, false);
  const int p = basis.degree(), h = (p - 1) / 2, count = basis.count();
  const Index n = count - p;  // spans
  check_rows("values", values.rows(), n + 1);
  check_rows("start", start.rows(), h);
  check_rows("end", end.rows(), h);
  Eigen::MatrixXd control = Eigen::MatrixXd::Zero(count, values.cols());

  // Order k at an end involves only the k + 1 outermost controls: forward substitution.
  const BSplineBasis::Local lo = basis.evaluate(basis.domain().lo, h),
                            hi = basis.evaluate(basis.domain().hi, h);
  control.row(0) = values.row(0);
  control.row(count - 1) = values.row(n);
  for (int k = 1; k <= h; ++k) {
    const auto& a = lo.value[static_cast<std::size_t>(k)];
    const auto& b = hi.value[static_cast<std::size_t>(k)];
    control.row(k) = start.row(k - 1);
    control.row(count - 1 - k) = end.row(k - 1);
    for (int i = 0; i < k; ++i) {
      control.row(k) -= a[static_cast<std::size_t>(i)] * control.row(i);
      control.row(count - 1 - k) -= b[static_cast<std::size_t>(p - i)] * control.row(count - 1 - i);
    }
    control.row(k) /= a[static_cast<std::size_t>(k)];
    control.row(count - 1 - k) /= b[static_cast<std::size_t>(p - k)];
  }
  if (n == 1) return control;

  // What is left is square and totally positive: values at the inner breaks, controls h + 1 .. count - h - 2.
  const Index m = n - 1;
  Eigen::MatrixXd bands = Eigen::MatrixXd::Zero(m, p), right = values.middleRows(1, m);
  for (Index i = 0; i < m; ++i) {
    const BSplineBasis::Local N = basis.evaluate(basis.breaks()[static_cast<std::size_t>(i + 1)], 0);
    for (int r = 0; r < p; ++r) {
      const Index unknown = i - h + r;
      const double value = N.value[0][static_cast<std::size_t>(r)];
      if (unknown < 0 || unknown >= m)
        right.row(i) -= value * control.row(unknown + h + 1);
      else
        bands(i, r) = value;
    }
  }
  control.middleRows(h + 1, m) = solve_banded(bands, h, false, right);
  return control;
}

template <int Dim>
BSplineCurve<Dim> interpolate_points(const std::vector<Eigen::Matrix<double, Dim, 1>>& points,
                                     const std::vector<double>& parameters, bool closed, int degree) {
  const std::size_t n = points.size();
  if (degree < 1 || degree > highest_degree || degree % 2 == 0)
    throw InputError("degree", "is " + std::to_string(degree) + ", must be 1, 3, 5, 7 or 9");
  if (n < static_cast<std::size_t>(degree) + 1)
    throw InputError("points", "has " + std::to_string(n) + ", degree " + std::to_string(degree) +
                                   " needs at least " + std::to_string(degree + 1));
  if (parameters.size() != n + (closed ? 1 : 0))
    throw InputError("parameters", "has " + std::to_string(parameters.size()) + ", must have " +
                                       std::to_string(n + (closed ? 1 : 0)) + " for " + std::to_string(n) +
                                       " points");
  check_neighbours<Dim>(points, closed);
  Eigen::MatrixXd values(static_cast<Index>(n), Dim);
  for (std::size_t i = 0; i < n; ++i) values.row(static_cast<Index>(i)) = points[i].transpose();

  Eigen::MatrixXd control;
  const auto basis = [&] {
    try {
      return closed ? BSplineBasis::closed(degree, parameters) : BSplineBasis::clamped(degree, parameters);
    } catch (const InputError&) {
      throw InputError("parameters", "must be finite and strictly increasing");
    }
  }();
  if (closed)
    control = periodic_control(basis, values);
  else
    control = complete_control(basis, values, end_derivatives(values, parameters, degree, false),
                               end_derivatives(values, parameters, degree, true));
  std::vector<Eigen::Matrix<double, Dim, 1>> poles(static_cast<std::size_t>(control.rows()));
  for (std::size_t i = 0; i < poles.size(); ++i) poles[i] = control.row(static_cast<Index>(i)).transpose();
  return {basis, std::move(poles)};
}

template <int Dim>
std::vector<double> chord_parameters(const std::vector<Eigen::Matrix<double, Dim, 1>>& points, bool closed) {
  if (points.size() < 2)
    throw InputError("points", "has " + std::to_string(points.size()) + ", needs at least 2");
  check_neighbours<Dim>(points, closed);
  std::vector<double> t{0.0};
  for (std::size_t i = 1; i < points.size(); ++i) t.push_back(t.back() + (points[i] - points[i - 1]).norm());
  if (closed) t.push_back(t.back() + (points.front() - points.back()).norm());
  const double length = t.back();
  for (double& x : t) x /= length;
  return t;
}

template BSplineCurve<1> interpolate_points<1>(const std::vector<Eigen::Matrix<double, 1, 1>>&,
                                               const std::vector<double>&, bool, int);
template BSplineCurve<2> interpolate_points<2>(const std::vector<Vec2>&, const std::vector<double>&, bool,
                                               int);
template BSplineCurve<3> interpolate_points<3>(const std::vector<Vec3>&, const std::vector<double>&, bool,
                                               int);
template std::vector<double> chord_parameters<1>(const std::vector<Eigen::Matrix<double, 1, 1>>&, bool);
template std::vector<double> chord_parameters<2>(const std::vector<Vec2>&, bool);
template std::vector<double> chord_parameters<3>(const std::vector<Vec3>&, bool);

}  // namespace blendwright
