#pragma once
// Distances to triangle meshes.
#include <memory>

#include "kernel/mesh/mesh.hpp"

namespace blendwright {

/// The point of a mesh that is next to another.
struct MeshFoot {
  std::uint32_t triangle = 0;
  Vec3 point = Vec3::Zero();
  double distance = 0.0;
  std::array<double, 3> weights{1.0, 0.0, 0.0};  ///< of the triangle's corners; they sum to 1
};

/// The closest point of one triangle, also of one without an area. Source: C. Ericson, Real-time collision
/// detection, 2005, section 5.1.5.
[[nodiscard]] MeshFoot closest_point(const std::array<Vec3, 3>& triangle, const Vec3& q);

/// A mesh with a tree over the boxes of its triangles.
class MeshTree {
 public:
  /// Throws InputError when there are no triangles, one names no point, or a coordinate is not finite.
  explicit MeshTree(TriMesh mesh);

  [[nodiscard]] const TriMesh& mesh() const;
  [[nodiscard]] std::array<Vec3, 3> corners(std::uint32_t triangle) const;
  [[nodiscard]] MeshFoot closest(const Vec3& q) const;
  [[nodiscard]] MeshFoot closest_on(std::uint32_t triangle, const Vec3& q) const;

  /// Neighbours run around opposite ways along every edge, and no edge has more than two: the mesh has sides.
  [[nodiscard]] bool oriented() const;
  /// The foot lies on an edge of one triangle only.
  [[nodiscard]] bool on_border(const MeshFoot& foot) const;
  /// Normal of the side at a foot: of the triangle, or the mean of those around an edge or a corner, weighted
  /// by their angles there, which tells the side of every point whose foot it is. Source: J. Baerentzen, H.
  /// Aanaes, Signed distance computation using the angle weighted pseudonormal, 2005. 0 without an area.
  [[nodiscard]] Vec3 side_normal(const MeshFoot& foot) const;
  /// Diagonal of the box around it.
  [[nodiscard]] double size() const;

  struct Impl;

 private:
  std::shared_ptr<const Impl> impl_;
};

}  // namespace blendwright
