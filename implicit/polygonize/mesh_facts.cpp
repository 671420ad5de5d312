#include "implicit/polygonize/mesh_facts.hpp"

#include <cmath>
#include <numeric>

#include "kernel/base/parallel_for.hpp"

namespace blendwright::detail {
namespace {

constexpr std::size_t chunk = 4096;

/// One partial result per chunk of [0, count), in order.
template <class Partial, class Body>
std::vector<Partial> partial_results(std::size_t count, Body body) {
  std::vector<Partial> partial((count + chunk - 1) / chunk);
  parallel_for(count, chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += chunk)
      partial[first / chunk] = body(first, std::min(end, first + chunk));
  });
  return partial;
}

/// Disjoint sets of points; the smaller number stands for a set.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n), count_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    --count_;
    parent_[std::max(a, b)] = std::min(a, b);
  }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::vector<std::uint32_t> parent_;
  std::size_t count_;
};

}  // namespace

AreaAndVolume area_and_volume(const TriMesh& mesh, const Vec3& centre) {
  const auto partial =
      partial_results<AreaAndVolume>(mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
        AreaAndVolume sum;
        for (std::size_t n = begin; n < end; ++n) {
          const auto [i, j, k] = mesh.triangles[n];
          const Vec3 a = mesh.points[i] - centre, b = mesh.points[j] - centre, c = mesh.points[k] - centre;
          const Vec3 twice_area = (b - a).cross(c - a);
          sum.area += 0.5 * twice_area.norm();
          sum.volume += a.dot(twice_area) / 6.0;
        }
        return sum;
      });
  AreaAndVolume total;
  for (const AreaAndVolume& p : partial) {
    total.area += p.area;
    total.volume += p.volume;
  }
  return total;
}

std::size_t components_of(const TriMesh& mesh) {
  Sets sets(mesh.points.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.join(a, b);
    sets.join(a, c);
  }
  return sets.count();
}

DistanceSummary summary_of(std::span<const double> distances) {
  struct Partial {
    double largest = 0.0, sum = 0.0;
    std::size_t count = 0;
  };
  const auto partial = partial_results<Partial>(distances.size(), [&](std::size_t begin, std::size_t end) {
    Partial p;
    for (std::size_t n = begin; n < end; ++n) {
      if (std::isnan(distances[n])) continue;
      p.largest = std::max(p.largest, std::abs(distances[n]));
      p.sum += std::abs(distances[n]);
      ++p.count;
    }
    return p;
  });
  Partial total;
  for (const Partial& p : partial) {
    total.largest = std::max(total.largest, p.largest);
    total.sum += p.sum;
    total.count += p.count;
  }
  return {total.largest, total.count > 0 ? total.sum / static_cast<double>(total.count) : 0.0};
}

std::size_t fill_missing_normals(TriMesh& mesh) {
  std::vector<bool> missing(mesh.points.size(), false);
  std::size_t count = 0;
  for (std::size_t i = 0; i < missing.size(); ++i)
    if (mesh.normals[i].isZero(0.0)) {
      missing[i] = true;
      ++count;
    }
  if (count == 0) return 0;
  for (const auto& t : mesh.triangles)
    if (missing[t[0]] || missing[t[1]] || missing[t[2]]) {
      const Vec3& a = mesh.points[t[0]];
      const Vec3 twice_area = (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a);
      for (const std::uint32_t i : t)
        if (missing[i]) mesh.normals[i] += twice_area;
    }
  for (std::size_t i = 0; i < missing.size(); ++i)
    if (missing[i]) mesh.normals[i].stableNormalize();
  return count;
}

}  // namespace blendwright::detail
