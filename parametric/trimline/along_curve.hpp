#pragma once
// Partials of a surface along a parameter curve, many at a time: the powers of the curve's increments are
// shared. Private to this module; the kernel's along() is the same for a single use.
#include <array>
#include <cmath>

#include "kernel/geometry/series.hpp"

namespace blendwright {

class AlongCurve {
 public:
  explicit AlongCurve(const Series2& uv) {
    Series du = uv[0], dv = uv[1];
    du.c[0] = dv.c[0] = 0.0;
    at(0, 0) = Series(1.0);
    for (int n = 1; n <= Series::order; ++n)
      for (int b = 0; b <= n; ++b)
        at(n - b, b) = b == 0 ? at(n - 1, 0) * du / static_cast<double>(n)
                              : at(n - b, b - 1) * dv / static_cast<double>(b);
  }
  /// d^{i+j} S / du^i dv^j, exact to order min(3, 4 - i - j); higher coefficients are 0.
  [[nodiscard]] Series3 operator()(const SurfacePartials& P, int i, int j) const {
    const int order = std::min(Series::order, 4 - i - j);
    Series3 sum{};
    for (int n = 0; n <= order; ++n)
      for (int b = 0; b <= n; ++b) {
        const Vec3& F = P(i + n - b, j + b);
        const Series& m = power_[SurfacePartials::index(n - b, b)];
        // A monomial of degree n starts at order n.
        for (int k = n; k <= order; ++k)
          for (std::size_t d = 0; d < 3; ++d)
            sum[d].c[static_cast<std::size_t>(k)] +=
                m.c[static_cast<std::size_t>(k)] * F[static_cast<Eigen::Index>(d)];
      }
    return sum;
  }

 private:
  [[nodiscard]] Series& at(int a, int b) { return power_[SurfacePartials::index(a, b)]; }
  std::array<Series, 10> power_;  ///< du^a dv^b / (a! b!), a + b <= 3
};

/// a^(-1/2), a > 0.
[[nodiscard]] inline Series inverse_sqrt(const Series& a) {
  const double x = 1.0 / a.value(), f = std::sqrt(x);
  return compose_scalar({f, -0.5 * f * x, 0.375 * f * x * x, -0.3125 * f * x * x * x}, a);
}

}  // namespace blendwright
