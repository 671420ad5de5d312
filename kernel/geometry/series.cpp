#include "kernel/geometry/series.hpp"

#include <algorithm>

namespace blendwright {

Series3 along(const SurfacePartials& P, int i, int j, const Series2& uv) {
  const int order = std::min(Series::order, 4 - i - j);  // what the partials up to total order 4 determine
  Series du = uv[0], dv = uv[1];
  du.c[0] = 0.0;
  dv.c[0] = 0.0;
  // F(u0 + du, v0 + dv) = sum_{a + b <= order} F_{u^a v^b} du^a dv^b / (a! b!), with du and dv of order h.
  Series3 sum{};
  Series u_power(1.0);  // du^a / a!
  for (int a = 0; a <= order; ++a) {
    Series term = u_power;
    for (int b = 0; a + b <= order; ++b) {
      const Vec3& F = P(i + a, j + b);
      for (std::size_t d = 0; d < 3; ++d) sum[d] = sum[d] + term * F[static_cast<Eigen::Index>(d)];
      term = term * dv / static_cast<double>(b + 1);
    }
    u_power = u_power * du / static_cast<double>(a + 1);
  }
  for (Series& s : sum)
    for (int k = order + 1; k <= Series::order; ++k) s.c[static_cast<std::size_t>(k)] = 0.0;
  return sum;
}

}  // namespace blendwright
