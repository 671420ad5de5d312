#pragma once
// Private: a face of the CAD kernel as one of our surfaces.
#include <Geom_Surface.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Ax3.hxx>
#include <memory>
#include <optional>
#include <string>

#include "kernel/geometry/surface.hpp"

namespace blendwright::detail {

struct FaceBoundary;

/// S(u, v) = G(u, v), or G(u, -v) when `mirrored`, so that Su x Sv can follow a reversed face. Evaluates the
/// geometry itself, never an adaptor: adaptors cache and may not be shared by threads.
class OcctSurface {
 public:
  /// `box` is in the parameters of S: of a mirrored surface, v is already negated.
  /// `boundary`: the edges of the face that the surface was taken from, where there is one.
  OcctSurface(opencascade::handle<Geom_Surface> geometry, bool mirrored, SurfaceDomain box,
              std::shared_ptr<const FaceBoundary> boundary = nullptr)
      : geometry_(std::move(geometry)), mirrored_(mirrored), box_(box), boundary_(std::move(boundary)) {}
  [[nodiscard]] SurfaceJet jet(UV p) const;
  [[nodiscard]] SurfacePartials partials(UV p) const;
  [[nodiscard]] SurfaceDomain domain() const { return box_; }
  /// Of planes, cylinders, cones, spheres, tori and polynomial B-splines.
  void enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const;
  [[nodiscard]] const opencascade::handle<Geom_Surface>& geometry() const { return geometry_; }
  [[nodiscard]] bool mirrored() const { return mirrored_; }
  [[nodiscard]] const std::shared_ptr<const FaceBoundary>& boundary() const { return boundary_; }

 private:
  opencascade::handle<Geom_Surface> geometry_;
  bool mirrored_;
  SurfaceDomain box_;
  std::shared_ptr<const FaceBoundary> boundary_;
};

/// What lies under a face: location applied, trimming stripped, parameter box of the face in the geometry's
/// parameters.
struct FaceGeometry {
  opencascade::handle<Geom_Surface> geometry;
  bool reversed = false;
  SurfaceDomain box;
  std::shared_ptr<const FaceBoundary> boundary{};  ///< where somebody asked for it
};
[[nodiscard]] FaceGeometry face_geometry(const TopoDS_Face& face);
/// The oriented surface; a forward, polynomial B-spline that the face uses whole becomes our own
/// BSplineSurface.
[[nodiscard]] Surface oriented_surface(const FaceGeometry& face);
/// The interval [-hi, -lo] of a mirrored parameter.
[[nodiscard]] inline Interval mirrored(const Interval& i) { return {-i.hi, -i.lo}; }

/// plane, cylinder, cone, sphere, torus, bspline, revolution, extrusion, other.
[[nodiscard]] std::string surface_kind(const opencascade::handle<Geom_Surface>& geometry);
/// What identifies the face beside its kind: "radius 3, length 12".
[[nodiscard]] std::string size_text(const FaceGeometry& face);

/// Parameters of the point of a plane, cylinder, cone, sphere or torus next to `p`; empty for other geometry.
[[nodiscard]] std::optional<Vec2> elementary_parameters(const opencascade::handle<Geom_Surface>& geometry,
                                                        const Vec3& p);
/// Parameters of the surface's point next to `p`, by Newton's method from a guess; at a pole the guess stays.
[[nodiscard]] Vec2 foot_near(const opencascade::handle<Geom_Surface>& geometry, const Vec3& p, Vec2 guess);
/// True when both are the same elementary surface as a set of points, to `tolerance` in position over `size`.
[[nodiscard]] bool same_elementary(const opencascade::handle<Geom_Surface>& a,
                                   const opencascade::handle<Geom_Surface>& b, double tolerance, double size);

}  // namespace blendwright::detail
