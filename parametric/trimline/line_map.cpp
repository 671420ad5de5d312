#include "parametric/trimline/line_map.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/math/quadrature.hpp"
#include "parametric/trimline/line_point.hpp"

namespace blendwright {
namespace {

double speed(const Trimline& line, double v) { return line_point(line, v).C1.norm(); }

bool constant_speed(const Trimline& line) {
  constexpr int samples = 48;
  double least = speed(line, line.domain().v.lo), most = least;
  for (int i = 1; i <= samples; ++i) {
    const double s = speed(line, line.domain().v.at(static_cast<double>(i) / samples));
    least = std::min(least, s);
    most = std::max(most, s);
  }
  return most - least <= 1e-12 * most;
}

/// Arc length from the start of the line to the nodes of n equal steps of v.
std::vector<double> cumulative_length(const Trimline& line, int n) {
  const Interval range = line.domain().v;
  const QuadratureRule& rule = gauss_legendre(4);
  std::vector<double> s{0.0};
  for (int k = 0; k < n; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.x.size(); ++i)
      sum += rule.w[i] * speed(line, range.at((k + rule.x[i]) / n));
    s.push_back(s.back() + sum * range.length() / n);
  }
  return s;
}

/// dv/dx and d2v/dx2 for x = s / length.
std::array<double, 2> end_slopes(const Trimline& line, double v, double length) {
  const LinePoint p = line_point(line, v);
  const double sigma = p.C1.norm(), slope = p.C1.dot(p.C2) / sigma;
  return {length / sigma, -length * length * slope / (sigma * sigma * sigma)};
}

/// Interpolates v at the fractions x_k = s_k / length, which need no inversion.
FractionMap inverted(const Trimline& line, const std::vector<double>& s) {
  const Interval range = line.domain().v;
  const std::size_t n = s.size() - 1;
  FractionMap map{range.lo, range.length(), std::nullopt};
  std::vector<double> x, rest;
  for (std::size_t k = 0; k <= n; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(n);
    x.push_back(k == n ? 1.0 : s[k] / s[n]);
    rest.push_back(range.length() * (t - x[k]));
  }
  if (line.domain().closed) {
    rest.pop_back();
    map.p = ScalarSpline::closed(std::move(x), rest);
    return map;
  }
  std::array<double, 2> start = end_slopes(line, range.lo, s[n]), end = end_slopes(line, range.hi, s[n]);
  start[0] -= map.b;
  end[0] -= map.b;
  map.p = ScalarSpline::open(std::move(x), rest, start, end);
  return map;
}

/// Largest |d(s/length)/dx - 1| at the middles between the nodes, where interpolation is worst.
double unevenness(const Trimline& line, const FractionMap& map, const std::vector<double>& s) {
  double worst = 0.0;
  for (std::size_t k = 0; k + 1 < s.size(); ++k) {
    const Series v = map(Series::variable(0.5 * (s[k] + s[k + 1]) / s.back()));
    worst = std::max(worst, std::abs(v.c[1] * speed(line, v.value()) / s.back() - 1.0));
  }
  return worst;
}

void check_speed(const Trimline& line, const std::vector<double>& s) {
  const Interval range = line.domain().v;
  const int n = static_cast<int>(s.size()) - 1;
  const double mean = s.back() / range.length();
  for (int k = 0; k <= n; ++k) {
    const double v = range.at(static_cast<double>(k) / n);
    const LinePoint p = line_point(line, v);
    if (!(p.C1.norm() > 1e-9 * mean) || !(p.C1.norm() > 1e-12 * p.reach))
      throw GeometryError("the trimline stops " + place(v, p.C) +
                          ": |C'| = 0, so its arc length is no parameter there; split it there or take the "
                          "correspondence as given");
  }
}

}  // namespace

FractionMap parameter_fraction(const Trimline& line) {
  return {line.domain().v.lo, line.domain().v.length(), std::nullopt};
}

FractionMap arc_length_fraction(const Trimline& line) {
  constexpr int first_nodes = 64, most_nodes = 1024;
  constexpr double even = 3e-7;  // at the middles of the spans; 1e-6 is promised everywhere
  if (constant_speed(line)) {
    check_speed(line, {0.0, line.domain().v.length() * speed(line, line.domain().v.lo)});
    return parameter_fraction(line);
  }
  for (int n = first_nodes;;) {
    const std::vector<double> s = cumulative_length(line, n);
    check_speed(line, s);
    FractionMap map = inverted(line, s);
    const double error = unevenness(line, map, s);
    if (error <= even || n >= most_nodes) return map;
    // The slope of a quintic spline has an error of fifth order in the steps.
    const double more = std::clamp(1.2 * std::pow(error / even, 0.2), 1.25, 8.0);
    n = std::min(static_cast<int>(std::ceil(more * n)), most_nodes);
  }
}

}  // namespace blendwright
