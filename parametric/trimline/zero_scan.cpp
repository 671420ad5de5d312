#include "parametric/trimline/zero_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "parametric/trimline/line_point.hpp"

namespace blendwright {
namespace {

constexpr int steps = 256;
/// A minimum counts as zero below this part of the mean: golden section finds the place of a double zero only
/// to about 1e-8 of the range, that of a simple one much better.
constexpr double zero = 1e-6;

double golden_minimum(const std::function<double(double)>& f, double lo, double hi) {
  constexpr double ratio = 0.6180339887498949;
  double a = hi - ratio * (hi - lo), b = lo + ratio * (hi - lo);
  double fa = f(a), fb = f(b);
  for (int i = 0; i < 60; ++i) {
    if (fa <= fb) {
      hi = b, b = a, fb = fa;
      a = hi - ratio * (hi - lo), fa = f(a);
    } else {
      lo = a, a = b, fa = fb;
      b = lo + ratio * (hi - lo), fb = f(b);
    }
  }
  return 0.5 * (lo + hi);
}

}  // namespace

std::vector<double> zero_scan_places(const CurveDomain& domain) {
  std::vector<double> places;
  for (int i = 0; i <= (domain.closed ? steps - 1 : steps); ++i)
    places.push_back(domain.v.at(static_cast<double>(i) / steps));
  return places;
}

std::vector<double> zeros(const CurveDomain& domain, const std::vector<double>& values,
                          const std::function<double(double)>& size) {
  const int n = static_cast<int>(values.size());
  const double h = domain.v.length() / steps, mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  const auto value = [&](int i) {
    if (domain.closed) return values[static_cast<std::size_t>((i + n) % n)];
    return i < 0 || i >= n ? std::numeric_limits<double>::infinity() : values[static_cast<std::size_t>(i)];
  };
  std::vector<double> found;
  for (int i = 0; i < n; ++i) {
    // A zero within half a step leaves less than this; larger minima are not refined.
    if (value(i) > 0.25 * mean || value(i) > value(i - 1) || value(i) > value(i + 1)) continue;
    const double node = domain.v.at(static_cast<double>(i) / steps);
    const double lo = domain.closed ? node - h : std::max(node - h, domain.v.lo);
    const double hi = domain.closed ? node + h : std::min(node + h, domain.v.hi);
    const double refined = golden_minimum(size, lo, hi);
    const double v = size(refined) < value(i) ? refined : node;
    if (size(v) > zero * mean) continue;
    const double inside = wrapped(domain, v).inside;
    if (found.empty() || std::abs(inside - found.back()) > 0.5 * h) found.push_back(inside);
  }
  return found;
}

}  // namespace blendwright
