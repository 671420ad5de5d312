#include "app/view/window/trimmed_mesh.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "kernel/base/parallel_for.hpp"

namespace blendwright {
namespace {

/// Distance to the line, > 0 on its kept side; of the nearest of its points, whose direction decides.
double kept_distance(const Vec3& p, const KeptSide& line) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const double d = (p - line.points[i]).squaredNorm();
    if (d < least) {
      least = d;
      nearest = i;
    }
  }
  return (p - line.points[nearest]).dot(line.inward[nearest]);
}

class Cutter {
 public:
  Cutter(const TriMesh& mesh, std::vector<double> kept) : mesh_(mesh), kept_(std::move(kept)) {
    made_.name = mesh.name;
    for (const auto& t : mesh.triangles) cut(t);
  }
  [[nodiscard]] TriMesh take() { return std::move(made_); }

 private:
  void cut(const std::array<std::uint32_t, 3>& t) {
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      if (kept_[a] >= 0.0) corners.push_back(point(a, a));
      if ((kept_[a] >= 0.0) != (kept_[b] >= 0.0)) corners.push_back(point(std::min(a, b), std::max(a, b)));
    }
    for (std::size_t i = 2; i < corners.size(); ++i)
      made_.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }

  /// The corner a, or the place between a and b where the line crosses.
  std::uint32_t point(std::uint32_t a, std::uint32_t b) {
    const auto [at, is_new] = places_.try_emplace({a, b}, static_cast<std::uint32_t>(made_.points.size()));
    if (!is_new) return at->second;
    const double w = a == b ? 0.0 : kept_[a] / (kept_[a] - kept_[b]);
    made_.points.push_back(mesh_.points[a] + w * (mesh_.points[b] - mesh_.points[a]));
    if (!mesh_.normals.empty())
      made_.normals.push_back((mesh_.normals[a] + w * (mesh_.normals[b] - mesh_.normals[a])).normalized());
    return at->second;
  }

  const TriMesh& mesh_;
  std::vector<double> kept_;
  TriMesh made_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> places_;
};

}  // namespace

TriMesh trimmed_mesh(const TriMesh& mesh, const std::vector<KeptSide>& lines) {
  std::vector<double> kept(mesh.points.size(), std::numeric_limits<double>::max());
  parallel_for(mesh.points.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (const KeptSide& line : lines) kept[i] = std::min(kept[i], kept_distance(mesh.points[i], line));
  });
  return Cutter(mesh, std::move(kept)).take();
}

}  // namespace blendwright
