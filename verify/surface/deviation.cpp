#include "verify/surface/deviation.hpp"

#include <cmath>
#include <optional>

#include "kernel/base/parallel_for.hpp"
#include "kernel/geometry/project.hpp"
#include "verify/surface/compass_search.hpp"
#include "verify/surface/sample_grid.hpp"

namespace blendwright {

SurfaceDeviation deviation(const Surface& first, const Surface& second, int nu, int nv,
                           const Progress& progress) {
  const detail::SampleGrid grid(first, nu, nv);
  const auto rows = static_cast<std::size_t>(grid.nu() + 1),
             columns = static_cast<std::size_t>(grid.nv() + 1);
  std::vector<Foot> feet(rows * columns);
  // Along a column each foot starts beside the last; its first, and any that ends on a border or jumps, is
  // searched for everywhere.
  parallel_for(columns, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      std::optional<Foot> last;
      for (std::size_t i = 0; i < rows; ++i) {
        const Vec3& q = grid.point(static_cast<int>(i), static_cast<int>(j));
        Foot& foot = feet[j * rows + i];
        if (last) foot = closest_point(second, q, last->at);
        const double step =
            last ? (q - grid.point(static_cast<int>(i) - 1, static_cast<int>(j))).norm() : 0.0;
        if (!last || !foot.interior || !(foot.distance <= last->distance + 2.0 * step)) {
          const Foot anywhere = closest_point(second, q);
          if (!last || !(foot.distance <= anywhere.distance)) foot = anywhere;
        }
        last = foot;
      }
    }
  });
  progress.at(0.9, "deviation");
  SurfaceDeviation result;
  double weight = 0.0, sum = 0.0;
  std::size_t worst = 0;
  for (std::size_t k = 0; k < feet.size(); ++k) {
    const double area = grid.at(static_cast<int>(k % rows), static_cast<int>(k / rows)).area;
    weight += area;
    sum += area * feet[k].distance * feet[k].distance;
    if (std::isnan(feet[worst].distance)) continue;
    if (!(feet[k].distance <= feet[worst].distance)) worst = k;
  }
  result.rms = weight > 0.0 ? std::sqrt(sum / weight) : feet[worst].distance;
  UV foot = feet[worst].at;
  const auto distance = [&](UV at) {
    const Foot f = closest_point(second, first.point(at), foot);
    return f.distance;
  };
  const SurfaceDomain domain = grid.domain();
  const detail::PeakUV peak = detail::compass_maximum(
      distance, domain,
      {grid.uv(static_cast<int>(worst % rows), static_cast<int>(worst / rows)), feet[worst].distance},
      0.5 * domain.u.length() / grid.nu(), 0.5 * domain.v.length() / grid.nv());
  result.worst = {peak.value, peak.at, first.point(peak.at)};
  result.other = closest_point(second, result.worst.point, foot).at;
  return result;
}

}  // namespace blendwright
