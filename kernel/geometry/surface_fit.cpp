#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/geometry/spline_interpolation.hpp"

namespace blendwright {
namespace {

using Eigen::Index;

// One row of data of a one-dimensional problem: the derivative of this order at t.
struct Line {
  double t;
  int order;
};

// Values at the breaks; then, for a clamped basis, orders 1..h at the start and 1..h at the end.
std::vector<Line> data_lines(const BSplineBasis& basis) {
  std::vector<Line> lines;
  for (double t : basis.breaks()) lines.push_back({t, 0});
  if (basis.periodic()) {
    lines.pop_back();
    return lines;
  }
  const int h = (basis.degree() - 1) / 2;
  for (double t : {basis.domain().lo, basis.domain().hi})
    for (int k = 1; k <= h; ++k) lines.push_back({t, k});
  return lines;
}

Eigen::MatrixXd control_of(const BSplineBasis& basis, const Eigen::MatrixXd& data) {
  if (basis.periodic()) return periodic_control(basis, data);
  const Index h = (basis.degree() - 1) / 2, values = data.rows() - 2 * h;
  return complete_control(basis, data.topRows(values), data.middleRows(values, h), data.bottomRows(h));
}

void check_direction(const char* where, const BSplineBasis& basis, bool closed) {
  const int p = basis.degree();
  if (p != 1 && p != 3 && p != 5)
    throw InputError(where, "degree is " + std::to_string(p) + ", must be 1, 3 or 5");
  if (basis.periodic() && !closed)
    throw InputError(where, "is periodic, but the surface is not closed in that direction");
}

std::vector<double> uniform_breaks(Interval range, int spans) {
  std::vector<double> t;
  for (int i = 0; i <= spans; ++i) t.push_back(range.at(static_cast<double>(i) / spans));
  return t;
}

BSplineBasis uniform_basis(int degree, Interval range, bool closed, int spans) {
  return closed ? BSplineBasis::closed(degree, uniform_breaks(range, spans))
                : BSplineBasis::clamped(degree, uniform_breaks(range, spans));
}

// Three places inside every span: where the error of the interpolant is largest (the middle) and beside.
std::vector<double> inner_points(const std::vector<double>& breaks) {
  std::vector<double> t;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (double f : {0.25, 0.5, 0.75}) t.push_back(Interval{breaks[i], breaks[i + 1]}.at(f));
  return t;
}

struct Distance {
  double value = 0.0;
  UV at;
};

Distance largest_distance(const Surface& surface, const BSplineSurface& spline, const std::vector<double>& u,
                          const std::vector<double>& v) {
  std::vector<Distance> row(u.size());
  parallel_for(u.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (double y : v) {
        const UV p{u[i], y};
        const double d = (surface.point(p) - spline.jet(p).S).norm();
        if (!(d <= row[i].value)) row[i] = {d, p};  // NaN counts as large
      }
  });
  return *std::max_element(row.begin(), row.end(),
                           [](const Distance& a, const Distance& b) { return a.value < b.value; });
}

}  // namespace

BSplineSurface interpolate_surface(const Surface& surface, const BSplineBasis& basis_u,
                                   const BSplineBasis& basis_v) {
  const SurfaceDomain domain = surface.domain();
  check_direction("basis_u", basis_u, domain.u_closed);
  check_direction("basis_v", basis_v, domain.v_closed);
  const std::vector<Line> lines_u = data_lines(basis_u), lines_v = data_lines(basis_v);
  const auto nu = static_cast<Index>(lines_u.size()), nv = static_cast<Index>(lines_v.size());

  Eigen::MatrixXd data(nu, 3 * nv);
  parallel_for(lines_u.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = 0; j < lines_v.size(); ++j) {
        const Line &a = lines_u[i], &b = lines_v[j];
        const UV p{a.t, b.t};
        const Vec3 d = a.order + b.order == 0 ? surface.point(p) : surface.partials(p)(a.order, b.order);
        data.block<1, 3>(static_cast<Index>(i), 3 * static_cast<Index>(j)) = d.transpose();
      }
  });
  const Eigen::MatrixXd along_u = control_of(basis_u, data);
  const Index rows = along_u.rows();
  Eigen::MatrixXd turned(nv, 3 * rows);
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < nv; ++j) turned.block<1, 3>(j, 3 * i) = along_u.block<1, 3>(i, 3 * j);
  const Eigen::MatrixXd net = control_of(basis_v, turned);
  std::vector<Vec3> control;
  control.reserve(static_cast<std::size_t>(rows * net.rows()));
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < net.rows(); ++j) control.push_back(net.block<1, 3>(j, 3 * i).transpose());
  return {basis_u, basis_v, std::move(control)};
}

SurfaceFit fit_surface(const Surface& surface, const SurfaceFitOptions& options, const Progress& progress) {
  if (options.degree != 3 && options.degree != 5)
    throw InputError("degree", "is " + std::to_string(options.degree) + ", must be 3 or 5");
  if (!(options.tolerance > 0.0)) throw InputError("tolerance", "must be > 0");
  const SurfaceDomain domain = surface.domain();
  int spans_u = 8, spans_v = 8;
  for (int round = 0;; ++round) {
    progress.at(1.0 - std::pow(0.8, round), "fitting a spline surface");
    const BSplineBasis basis_u = uniform_basis(options.degree, domain.u, domain.u_closed, spans_u);
    const BSplineBasis basis_v = uniform_basis(options.degree, domain.v, domain.v_closed, spans_v);
    BSplineSurface spline = interpolate_surface(surface, basis_u, basis_v);
    const std::vector<double> u = inner_points(basis_u.breaks()), v = inner_points(basis_v.breaks());
    // On lines through the breaks of one direction the error is that of the other direction alone.
    const Distance in_u = largest_distance(surface, spline, u, basis_v.breaks());
    const Distance in_v = largest_distance(surface, spline, basis_u.breaks(), v);
    Distance worst =
        std::max(in_u, in_v, [](const Distance& a, const Distance& b) { return a.value < b.value; });
    bool more_u = !(in_u.value <= options.tolerance), more_v = !(in_v.value <= options.tolerance);
    if (!more_u && !more_v) {
      const Distance inside = largest_distance(surface, spline, u, v);
      if (!(inside.value <= worst.value)) worst = inside;
      if (worst.value <= options.tolerance) return {std::move(spline), worst.value, worst.at};
      more_u = more_v = true;
    }
    if (more_u) spans_u *= 2;
    if (more_v) spans_v *= 2;
    if (spans_u > options.max_spans || spans_v > options.max_spans)
      throw ConvergenceError(
          "spline fit of a surface: distance " + scientific_text(worst.value) +
          " at u = " + number_text(worst.at.u) + ", v = " + number_text(worst.at.v) + " with " +
          std::to_string(basis_u.breaks().size() - 1) + " x " + std::to_string(basis_v.breaks().size() - 1) +
          " spans; at most " + std::to_string(options.max_spans) +
          " a direction are allowed, the tolerance is " + scientific_text(options.tolerance));
  }
}

}  // namespace blendwright
