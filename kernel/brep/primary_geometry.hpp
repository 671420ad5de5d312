#pragma once
// Private: a primary as geometry of the CAD kernel.
#include <Geom_Surface.hxx>
#include <gp_Trsf.hxx>
#include <memory>
#include <optional>

#include "kernel/geometry/surface.hpp"

namespace blendwright::detail {

struct FaceBoundary;

/// The geometry G and the map of parameters, S(u, v) = G(origin + map (u, v)).
struct PrimaryGeometry {
  opencascade::handle<Geom_Surface> geometry;
  Eigen::Matrix2d map = Eigen::Matrix2d::Identity();
  Vec2 origin = Vec2::Zero();
  SurfaceDomain box;  ///< in G's parameters
  /// Edges around the face that the surface was taken from: in G's parameters once `shift` is added, in space
  /// once `placement` is applied. Empty for other surfaces.
  std::shared_ptr<const FaceBoundary> boundary{};
  Vec2 shift = Vec2::Zero();
  gp_Trsf placement{};
  [[nodiscard]] Vec2 operator()(const Vec2& uv) const { return origin + map * uv; }
  /// G's normal is opposite to Su x Sv.
  [[nodiscard]] bool flipped() const { return map.determinant() < 0.0; }
};

/// The exact geometry of planes, circular cylinders, cones, spheres, tori, B-splines and faces of a part,
/// also placed; empty for any other surface.
[[nodiscard]] std::optional<PrimaryGeometry> own_geometry(const Surface& surface);
/// The same; any other surface becomes a B-spline within `tolerance` of it.
[[nodiscard]] PrimaryGeometry primary_geometry(const Surface& surface, double tolerance);

/// The same surface with the seams of its closed directions at `seams` (in the old parameters; where a
/// direction is open, the value is not used).
[[nodiscard]] PrimaryGeometry with_seams(const PrimaryGeometry& primary, const Vec2& seams);

}  // namespace blendwright::detail
