#include "verify/second/differences.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace blendwright::detail {

Derivative difference_quotient(const std::function<Vec3(double)>& f, double x, const Interval& range) {
  constexpr int rows = 28, columns = 9;
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const double below = x - range.lo, above = range.hi - x;
  const bool central = std::min(below, above) > 1e-2 * range.length();
  double h = 0.125 * (central ? std::min(below, above) : std::max(below, above));
  if (!central && below > above) h = -h;

  const Vec3 here = central ? Vec3(Vec3::Zero()) : f(x);
  double largest = here.cwiseAbs().maxCoeff();
  const auto quotient = [&](double step) -> Vec3 {
    const double far = x + step, near = central ? x - step : x;  // what rounding made of the steps
    const Vec3 a = f(far), b = central ? f(near) : here;
    largest = std::max({largest, a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()});
    return (a - b) / (far - near);
  };

  Derivative best{Vec3::Zero(), std::numeric_limits<double>::infinity()};
  std::array<Vec3, columns> before, row;
  for (int k = 0; k < rows; ++k, h *= 0.5) {
    row[0] = quotient(h);
    const double rounding = 2.0 * eps * largest / std::abs(h);
    if (rounding > best.error) break;  // and every later row is worse
    double growth = 1.0;
    for (int j = 1; j < columns && j <= k; ++j) {
      const auto i = static_cast<std::size_t>(j);
      const double power = std::pow(2.0, central ? 2 * j : j);
      row[i] = row[i - 1] + (row[i - 1] - before[i - 1]) / (power - 1.0);
      growth *= (power + 1.0) / (power - 1.0);
      const double error =
          std::max((row[i] - row[i - 1]).norm(), (row[i] - before[i - 1]).norm()) + rounding * growth;
      if (error < best.error) best = {row[i], error};
    }
    before = row;
  }
  return best;
}

}  // namespace blendwright::detail
