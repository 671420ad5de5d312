#include "parametric/trimline/scalar_spline.hpp"

#include <algorithm>
#include <cmath>

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
  const BSplineBasis basis = BSplineBasis::closed(degree, std::move(breaks));
  return ScalarSpline(basis, to_vector(periodic_control(basis, column(values))));
}

ScalarSpline ScalarSpline::open(std::vector<double> breaks, const std::vector<double>& values,
                                std::array<double, 2> start, std::array<double, 2> end) {
  const BSplineBasis basis = BSplineBasis::clamped(degree, std::move(breaks));
  const Eigen::MatrixXd s = Eigen::Map<const Eigen::VectorXd>(start.data(), 2);
  const Eigen::MatrixXd e = Eigen::Map<const Eigen::VectorXd>(end.data(), 2);
  return ScalarSpline(basis, to_vector(complete_control(basis, column(values), s, e)));
}

ScalarSpline ScalarSpline::open(std::vector<double> breaks, const std::vector<double>& values) {
  const auto n = static_cast<std::ptrdiff_t>(std::min<std::size_t>(5, breaks.size()));
  const auto start = end_derivatives(breaks.front(), {breaks.begin(), breaks.begin() + n},
                                     {values.begin(), values.begin() + n});
  const auto end =
      end_derivatives(breaks.back(), {breaks.end() - n, breaks.end()}, {values.end() - n, values.end()});
  return open(std::move(breaks), values, start, end);
}

ScalarSpline::ScalarSpline(const BSplineBasis& basis, const std::vector<double>& control)
    : breaks_(basis.breaks()), closed_(basis.periodic()) {
  const auto derivatives = [&](double t) {
    const BSplineBasis::Local local = basis.evaluate(t, 4);
    std::array<double, 5> f{};
    for (std::size_t k = 0; k < f.size(); ++k)
      for (int i = 0; i <= degree; ++i)
        f[k] += local.value[k][static_cast<std::size_t>(i)] *
                control[static_cast<std::size_t>(basis.index(local.first + i))];
    return f;
  };
  for (std::size_t span = 0; span + 1 < breaks_.size(); ++span) {
    const double h = breaks_[span + 1] - breaks_[span];
    const std::array<double, 5> f = derivatives(breaks_[span]);
    std::array<double, degree + 1> c{};
    double scale = 1.0, sum = 0.0;
    for (std::size_t k = 0; k < f.size(); ++k) {
      if (k > 0) scale *= h / static_cast<double>(k);
      c[k] = f[k] * scale;
      sum += c[k];
    }
    c[degree] = derivatives(breaks_[span + 1])[0] - sum;  // ends at the next break's value
    polynomials_.push_back(c);
  }
}

ScalarSpline::Place ScalarSpline::place(double t) const {
  const double lo = breaks_.front(), hi = breaks_.back();
  if (closed_) t -= (hi - lo) * std::floor((t - lo) / (hi - lo));
  const auto next = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, t);
  const auto span = static_cast<std::size_t>(next - breaks_.begin()) - 1;
  return {span, (t - breaks_[span]) / (breaks_[span + 1] - breaks_[span])};
}

double ScalarSpline::operator()(double t) const {
  const auto [span, x] = place(t);
  const std::array<double, degree + 1>& c = polynomials_[span];
  double f = c[degree];
  for (std::size_t k = degree; k-- > 0;) f = f * x + c[k];
  return f;
}

Series ScalarSpline::operator()(const Series& t) const {
  const auto [span, x] = place(t.value());
  // Taylor shift of the polynomial to x by repeated synthetic division; only the first four coefficients are
  // needed.
  std::array<double, degree + 1> c = polynomials_[span];
  for (std::size_t k = 0; k <= Series::order; ++k)
    for (std::size_t j = degree; j-- > k;) c[j] += x * c[j + 1];
  const double per_step = 1.0 / (breaks_[span + 1] - breaks_[span]);
  std::array<double, Series::order + 1> f{};
  double scale = 1.0;
  for (std::size_t k = 0; k < f.size(); ++k) {
    f[k] = c[k] * scale;
    scale *= per_step;
  }
  return compose_scalar(f, t);
}

ModelJet ScalarSpline::operator()(const ModelJet& t) const {
  constexpr std::size_t most_pieces = 4;
  const double lo = breaks_.front(), hi = breaks_.back();
  const TaylorModel inside = inside_range(t.c[0], lo, hi, closed_);
  const Bounds range = inside.range();
  if (!range.finite()) return unknown_jet();
  ModelJet result = unknown_jet();
  std::size_t pieces = 0;
  for (std::size_t span = 0; span < polynomials_.size(); ++span) {
    const bool first = span == 0, last = span + 1 == polynomials_.size();
    if ((range.hi < breaks_[span] && !first) || (range.lo > breaks_[span + 1] && !last)) continue;
    ModelJet x = t;
    x.c[0] = inside;
    x = (x - breaks_[span]) / ModelJet(TaylorModel(Bounds(breaks_[span + 1]) - Bounds(breaks_[span])));
    ModelJet f(polynomials_[span][degree]);
    for (std::size_t k = degree; k-- > 0;) f = f * x + polynomials_[span][k];
    if (++pieces > most_pieces) return unknown_jet();
    for (std::size_t k = 0; k < f.c.size(); ++k)
      result.c[k] = pieces == 1 ? f.c[k] : TaylorModel::hull(result.c[k], f.c[k]);
  }
  return result;
}

}  // namespace blendwright
