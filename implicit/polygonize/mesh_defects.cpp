#include <tbb/parallel_sort.h>

#include <algorithm>
#include <compare>

#include "implicit/polygonize/polygonize.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

/// An edge of a triangle; `down`: it runs from the higher to the lower number.
struct DirectedEdge {
  std::uint32_t low, high;
  bool down;
  auto operator<=>(const DirectedEdge&) const = default;
};

std::vector<DirectedEdge> sorted_edges(const TriMesh& mesh) {
  std::vector<DirectedEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (std::size_t n = 0; n < 3; ++n) {
      const std::uint32_t a = t[n], b = t[(n + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a > b});
    }
  tbb::parallel_sort(edges.begin(), edges.end());
  return edges;
}

void count_edges(const TriMesh& mesh, MeshDefects& defects) {
  const std::vector<DirectedEdge> edges = sorted_edges(mesh);
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::find_if(first, edges.end(), [&](const DirectedEdge& e) {
      return e.low != first->low || e.high != first->high;
    });
    const auto uses = last - first;
    if (uses == 1) ++defects.open_edges;
    if (uses > 2) ++defects.overused_edges;
    if (uses == 2 && first->down == (first + 1)->down) ++defects.flipped_edges;
    first = last;
  }
}

bool degenerate(const TriMesh& mesh, const std::array<std::uint32_t, 3>& t, double least_area) {
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return true;
  const Vec3& a = mesh.points[t[0]];
  const double area = 0.5 * (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a).norm();
  return !(area >= least_area);  // also when a coordinate is NaN
}

std::size_t repeated(std::vector<Vec3> points) {
  const auto order = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::erase_if(points, [](const Vec3& p) { return p.hasNaN(); });
  tbb::parallel_sort(points.begin(), points.end(), order);
  std::size_t count = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i] == points[i - 1]) ++count;
  return count;
}

}  // namespace

MeshDefects find_defects(const TriMesh& mesh, double cell) {
  MeshDefects defects;
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t i : t)
      if (i >= mesh.points.size())
        throw InputError("triangles", "name point " + number_text(i) + ", but there are only " +
                                          number_text(static_cast<double>(mesh.points.size())));
    if (degenerate(mesh, t, 1e-12 * cell * cell)) ++defects.degenerate_faces;
  }
  count_edges(mesh, defects);
  defects.repeated_points = repeated(mesh.points);
  return defects;
}

}  // namespace blendwright
