#include "kernel/brep/extrema.hpp"

#include <Extrema_ExtPS.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_ElementarySurface.hxx>
#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/brep/extrema_impl.hpp"
#include "kernel/brep/told_surface.hpp"

namespace blendwright {
namespace {

using detail::PrimaryGeometry;
using opencascade::handle;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Extrema are looked for inside the bounds only. An open border is passed by a thousandth of the range, so
/// that a point beside it has its foot inside; a closed direction overlaps itself, so that none hides at the
/// seam.
Interval widened(const Interval& range, bool closed) {
  const double more = (closed ? 0.05 : 1e-3) * range.length();
  return {range.lo - more, range.hi + more};
}

/// The nearest of all extrema, led on to where the residual is normal to the surface.
ExtremaFoot search(const Adaptor3d_Surface& surface, const SurfaceDomain& bounds, const Vec3& q) {
  Extrema_ExtPS extrema(detail::pnt(q), surface, bounds.u.lo, bounds.u.hi, bounds.v.lo, bounds.v.hi, 1e-10,
                        1e-10);
  ExtremaFoot foot{{nan, nan}, nan, nan};
  if (!extrema.IsDone() || extrema.NbExt() == 0) return foot;
  int nearest = 1;
  for (int i = 2; i <= extrema.NbExt(); ++i)
    if (extrema.SquareDistance(i) < extrema.SquareDistance(nearest)) nearest = i;
  extrema.Point(nearest).Parameter(foot.at.u, foot.at.v);
  // What the search leaves along the surface would be a distance of its own where the surfaces all but meet.
  for (int step = 0;; ++step) {
    gp_Pnt point;
    gp_Vec du, dv;
    surface.D1(foot.at.u, foot.at.v, point, du, dv);
    const Vec3 a = detail::vec(du), b = detail::vec(dv), r = q - detail::vec(point), n = a.cross(b);
    foot.distance = r.norm();
    foot.slack = n.isZero(0.0) ? 0.0 : (r - r.dot(n) / n.squaredNorm() * n).norm();
    const double E = a.dot(a), F = a.dot(b), G = b.dot(b), det = E * G - F * F;
    if (step == 3 || !(det > 1e-12 * E * G)) return foot;
    foot.at.u += (G * a.dot(r) - F * b.dot(r)) / det;
    foot.at.v += (E * b.dot(r) - F * a.dot(r)) / det;
  }
}

ExtremaFoot closest_on(const PrimaryGeometry& g, const Vec3& q) {
  const GeomAdaptor_Surface adaptor(g.geometry);
  SurfaceDomain bounds;
  g.geometry->Bounds(bounds.u.lo, bounds.u.hi, bounds.v.lo, bounds.v.hi);
  if (!g.geometry->IsKind(STANDARD_TYPE(Geom_ElementarySurface))) {
    // The box of a face, since an extrusion has no bounds of its own.
    bounds.u = widened(g.box.u, g.geometry->IsUPeriodic());
    bounds.v = widened(g.box.v, g.geometry->IsVPeriodic());
  }
  ExtremaFoot foot = search(adaptor, bounds, q);
  const Vec2 ours = g.map.inverse() * (Vec2(foot.at.u, foot.at.v) - g.origin);
  foot.at = {ours.x(), ours.y()};
  return foot;
}

ExtremaFoot closest_on(const Surface& surface, const Vec3& q) {
  const SurfaceDomain d = surface.domain();
  const SurfaceDomain bounds{widened(d.u, d.u_closed), widened(d.v, d.v_closed)};
  return search(detail::ToldSurface(surface, bounds), bounds, q);
}

}  // namespace

ExtremaSurface ExtremaSurface::of(const Surface& surface) {
  return detail::guarded<GeometryError>("extrema", [&] {
    const auto own = detail::own_geometry(surface);
    return ExtremaSurface(std::make_shared<const Impl>(own ? Impl{*own} : Impl{surface}));
  });
}

ExtremaSurface extrema_surface(const opencascade::handle<Geom_Surface>& geometry, const SurfaceDomain& box) {
  PrimaryGeometry held;
  held.geometry = geometry;
  held.box = box;
  return ExtremaSurface(std::make_shared<const ExtremaSurface::Impl>(ExtremaSurface::Impl{held}));
}

bool ExtremaSurface::evaluates() const { return std::holds_alternative<PrimaryGeometry>(impl_->held); }

Vec3 ExtremaSurface::point(UV at) const {
  if (const auto* surface = std::get_if<Surface>(&impl_->held)) return surface->point(at);
  const auto& g = std::get<PrimaryGeometry>(impl_->held);
  const Vec2 uv = g({at.u, at.v});
  return detail::vec(g.geometry->Value(uv.x(), uv.y()));
}

ExtremaFoot ExtremaSurface::closest(const Vec3& q) const {
  if (!q.allFinite()) return {{nan, nan}, nan, nan};
  try {
    return std::visit([&](const auto& held) { return closest_on(held, q); }, impl_->held);
  } catch (const Standard_Failure&) {
    return {{nan, nan}, nan, nan};  // a second opinion that cannot be had is none
  }
}

}  // namespace blendwright
