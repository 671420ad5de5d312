#include "kernel/brep/primary_geometry.hpp"

#include <Geom_BSplineSurface.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <cmath>
#include <optional>

#include "kernel/brep/occt_geometry.hpp"
#include "kernel/brep/occt_surface.hpp"
#include "kernel/geometry/rigid_motion.hpp"
#include "kernel/geometry/spline_interpolation.hpp"
#include "kernel/primitives/quadrics.hpp"

namespace blendwright::detail {
namespace {

using opencascade::handle;

SurfaceDomain swapped(const SurfaceDomain& d) { return {d.v, d.u, d.v_closed, d.u_closed}; }

/// Ours is (profile, angle), theirs (angle, profile).
PrimaryGeometry turned(const handle<Geom_Surface>& geometry, const SurfaceDomain& ours) {
  PrimaryGeometry p;
  p.geometry = geometry;
  p.map << 0.0, 1.0, 1.0, 0.0;
  p.box = swapped(ours);
  return p;
}

std::optional<PrimaryGeometry> elementary(const Surface& s) {
  const gp_Ax3 xyz;
  if (const auto* plane = s.target<Plane>()) {
    PrimaryGeometry p;
    p.geometry = new Geom_Plane(xyz);
    p.box = plane->domain();
    return p;
  }
  if (const auto* c = s.target<Cylinder>())
    return turned(new Geom_CylindricalSurface(xyz, c->shape().radius), c->domain());
  if (const auto* c = s.target<Cone>())
    return turned(new Geom_ConicalSurface(xyz, c->shape().half_angle.value, c->shape().radius), c->domain());
  if (const auto* b = s.target<Sphere>())
    return turned(new Geom_SphericalSurface(xyz, b->shape().radius), b->domain());
  if (const auto* t = s.target<Torus>())
    return turned(new Geom_ToroidalSurface(xyz, t->shape().major_radius, t->shape().minor_radius),
                  t->domain());
  if (const auto* b = s.target<BSplineSurface>()) {
    PrimaryGeometry p;
    p.geometry = to_occt(*b);
    p.box = b->domain();
    return p;
  }
  if (const auto* o = s.target<OcctSurface>()) {
    PrimaryGeometry p;
    p.geometry = o->geometry();
    p.boundary = o->boundary();
    p.box = o->domain();
    if (o->mirrored()) {
      p.map(1, 1) = -1.0;
      p.box.v = mirrored(p.box.v);
    }
    return p;
  }
  return std::nullopt;
}

gp_Trsf transform(const RigidMotion& m) {
  gp_Trsf t;
  t.SetValues(m.R(0, 0), m.R(0, 1), m.R(0, 2), m.t.x(), m.R(1, 0), m.R(1, 1), m.R(1, 2), m.t.y(), m.R(2, 0),
              m.R(2, 1), m.R(2, 2), m.t.z());
  return t;
}

void place(PrimaryGeometry& p, const RigidMotion& motion) {
  p.placement = transform(motion);
  p.geometry = handle<Geom_Surface>::DownCast(p.geometry->Transformed(p.placement));
}

/// The knot nearest to x, inserted where there is none, becomes the first one of direction `d`.
void move_spline_seam(const handle<Geom_BSplineSurface>& spline, int d, double x) {
  const auto knot = [&](int i) { return d == 0 ? spline->UKnot(i) : spline->VKnot(i); };
  const auto count = [&] { return d == 0 ? spline->NbUKnots() : spline->NbVKnots(); };
  const double period = knot(count()) - knot(1);
  x -= period * std::floor((x - knot(1)) / period);
  const auto index = [&] {
    for (int i = 1; i < count(); ++i)
      if (std::abs(knot(i) - x) <= 1e-12 * period) return i;
    return 0;
  };
  if (index() == 0) d == 0 ? spline->InsertUKnot(x, 1, 0.0) : spline->InsertVKnot(x, 1, 0.0);
  if (const int i = index(); i > 1) d == 0 ? spline->SetUOrigin(i) : spline->SetVOrigin(i);
}

/// The axis that an elementary surface or surface of revolution turns about, so that U grows
/// counter-clockwise.
std::optional<gp_Ax1> turning_axis(const handle<Geom_Surface>& g) {
  if (const auto e = handle<Geom_ElementarySurface>::DownCast(g); e && !g->IsKind(STANDARD_TYPE(Geom_Plane)))
    return e->Position().Direct() ? e->Position().Axis() : e->Position().Axis().Reversed();
  if (const auto r = handle<Geom_SurfaceOfRevolution>::DownCast(g)) return r->Axis();
  return std::nullopt;
}

}  // namespace

std::optional<PrimaryGeometry> own_geometry(const Surface& surface) {
  const auto* moved = surface.target<PlacedSurface>();
  if (!moved) return elementary(surface);
  std::optional<PrimaryGeometry> p = own_geometry(moved->shape);
  if (p) place(*p, moved->motion);
  return p;
}

PrimaryGeometry primary_geometry(const Surface& surface, double tolerance) {
  if (const auto own = own_geometry(surface)) return *own;
  PrimaryGeometry p;
  if (const auto* moved = surface.target<PlacedSurface>()) {
    p = primary_geometry(moved->shape, tolerance);
    place(p, moved->motion);
    return p;
  }
  p.box = surface.domain();
  p.geometry = to_occt(fit_surface(surface, {.tolerance = tolerance}).surface);
  return p;
}

PrimaryGeometry with_seams(const PrimaryGeometry& primary, const Vec2& seams) {
  PrimaryGeometry p = primary;
  if (const auto spline = handle<Geom_BSplineSurface>::DownCast(primary.geometry)) {
    const auto copy = handle<Geom_BSplineSurface>::DownCast(spline->Copy());
    if (p.box.u_closed && copy->IsUPeriodic()) move_spline_seam(copy, 0, seams.x());
    if (p.box.v_closed && copy->IsVPeriodic()) move_spline_seam(copy, 1, seams.y());
    p.geometry = copy;
    if (p.box.u_closed) p.box.u = {copy->UKnot(1), copy->UKnot(copy->NbUKnots())};
    if (p.box.v_closed) p.box.v = {copy->VKnot(1), copy->VKnot(copy->NbVKnots())};
    return p;
  }
  if (p.box.u_closed) {
    const double period = p.box.u.length();
    if (const auto axis = turning_axis(p.geometry)) {
      p.geometry = handle<Geom_Surface>::DownCast(p.geometry->Rotated(*axis, seams.x()));
      p.origin.x() -= seams.x();
      p.shift.x() -= seams.x();
      p.box.u = {0.0, period};
    } else {
      p.box.u = {seams.x(), seams.x() + period};
    }
  }
  if (p.box.v_closed) p.box.v = {seams.y(), seams.y() + p.box.v.length()};
  return p;
}

}  // namespace blendwright::detail
