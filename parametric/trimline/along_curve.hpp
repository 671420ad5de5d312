#pragma once
// Partials of a surface along a parameter curve, many at a time: the powers of the curve's increments are
// shared. Private to this module; the kernel's along() is the same for a single use.
#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/geometry/series.hpp"

namespace blendwright {

class AlongCurve {
 public:
  /// Only the increments of `uv` are used; its constant terms are where the partials are taken.
  explicit AlongCurve(const Series2& uv) {
    const double u1 = uv[0].c[1], u2 = uv[0].c[2], u3 = uv[0].c[3];
    const double v1 = uv[1].c[1], v2 = uv[1].c[2], v3 = uv[1].c[3];
    power_ = {{{1.0, 0.0, 0.0, 0.0},
               {0.0, u1, u2, u3},
               {0.0, v1, v2, v3},
               {0.0, 0.0, 0.5 * u1 * u1, u1 * u2},
               {0.0, 0.0, u1 * v1, u1 * v2 + u2 * v1},
               {0.0, 0.0, 0.5 * v1 * v1, v1 * v2},
               {0.0, 0.0, 0.0, u1 * u1 * u1 / 6.0},
               {0.0, 0.0, 0.0, 0.5 * u1 * u1 * v1},
               {0.0, 0.0, 0.0, 0.5 * u1 * v1 * v1},
               {0.0, 0.0, 0.0, v1 * v1 * v1 / 6.0}}};
  }
  /// d^{i+j} S / du^i dv^j, exact to order min(3, 4 - i - j); higher coefficients are 0.
  [[nodiscard]] Series3 operator()(const SurfacePartials& P, int i, int j) const {
    const int order = std::min(Series::order, 4 - i - j);
    Series3 sum{};
    for (int n = 0; n <= order; ++n)
      for (int b = 0; b <= n; ++b) {
        const Vec3& F = P(i + n - b, j + b);
        const auto& m = power_[SurfacePartials::index(n - b, b)];
        for (auto k = static_cast<std::size_t>(n); k <= static_cast<std::size_t>(order); ++k)
          for (std::size_t d = 0; d < 3; ++d) sum[d].c[k] += m[k] * F[static_cast<Eigen::Index>(d)];
      }
    return sum;
  }

 private:
  /// Coefficients of du^a dv^b / (a! b!), a + b <= 3, in the order of SurfacePartials; they start at order a
  /// + b.
  std::array<std::array<double, Series::order + 1>, 10> power_;
};

/// a^(-1/2), a > 0.
[[nodiscard]] inline Series inverse_sqrt(const Series& a) {
  const double x = 1.0 / a.value(), f = std::sqrt(x);
  return compose_scalar({f, -0.5 * f * x, 0.375 * f * x * x, -0.3125 * f * x * x * x}, a);
}

}  // namespace blendwright
