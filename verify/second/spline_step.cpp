#include "verify/second/spline_step.hpp"

#include <algorithm>
#include <complex>
#include <limits>

namespace blendwright::detail {
namespace {

constexpr double h = 1e-40;
using Complex = std::complex<double>;
template <class T>
using Point = Eigen::Matrix<T, 3, 1>;

/// The span of the breaks that a parameter lies in.
std::size_t span_of(const BSplineBasis& basis, double t) {
  const std::vector<double>& breaks = basis.breaks();
  const auto after = std::upper_bound(breaks.begin(), breaks.end() - 1, t);
  return after == breaks.begin() ? 0 : static_cast<std::size_t>(after - breaks.begin()) - 1;
}

/// de Boor's triangle over the degree + 1 values of one span.
template <class T>
Point<T> de_boor(std::span<const double> knots, std::vector<Point<T>> d, const T& t) {
  const std::size_t p = d.size() - 1;
  for (std::size_t r = 1; r <= p; ++r)
    for (std::size_t j = p; j >= r; --j) {
      const T a = (t - knots[j - 1]) / (knots[j + p - r] - knots[j - 1]);
      d[j] = (T(1.0) - a) * d[j - 1] + a * d[j];
    }
  return d[p];
}

struct Place {
  const BSplineBasis& basis;
  double t;
  std::size_t span = span_of(basis, t);
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(basis.degree()) + 1; }
  [[nodiscard]] std::span<const double> knots() const { return basis.span_knots(span); }
  [[nodiscard]] int index(std::size_t i) const {
    return basis.index(basis.first_function(span) + static_cast<int>(i));
  }
  [[nodiscard]] double rounding(double largest) const {
    const double width = basis.breaks()[span + 1] - basis.breaks()[span];
    return 8.0 * basis.degree() * std::numeric_limits<double>::epsilon() * largest / width;
  }
};

/// d/d(step) at `step.t`, `still.t`; control(i, j) of the i-th value of `step` and the j-th of `still`.
template <class Control>
Vec3 derivative(const Place& step, const Place& still, const Control& control) {
  std::vector<Point<Complex>> values;
  for (std::size_t i = 0; i < step.count(); ++i) {
    std::vector<Point<double>> across;
    for (std::size_t j = 0; j < still.count(); ++j) across.push_back(control(step.index(i), still.index(j)));
    values.emplace_back(de_boor<double>(still.knots(), std::move(across), still.t).cast<Complex>());
  }
  return de_boor<Complex>(step.knots(), std::move(values), Complex(step.t, h)).imag() / h;  // (1)
}

}  // namespace

SplineTangents complex_step(const BSplineSurface& surface, UV at) {
  const Place u{surface.basis_u(), at.u}, v{surface.basis_v(), at.v};
  const double largest = largest_control(surface);
  return {derivative(u, v, [&](int i, int j) { return surface.control(i, j); }),
          derivative(v, u, [&](int i, int j) { return surface.control(j, i); }), u.rounding(largest),
          v.rounding(largest)};
}

double largest_control(const BSplineSurface& surface) {
  double largest = 0.0;
  for (const Vec3& p : surface.control()) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

}  // namespace blendwright::detail
