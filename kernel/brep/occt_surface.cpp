#include "kernel/brep/occt_surface.hpp"

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <ElSLib.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "kernel/base/number_text.hpp"
#include "kernel/brep/face_boundary.hpp"
#include "kernel/brep/occt_geometry.hpp"
#include "kernel/geometry/enclosure.hpp"

namespace blendwright::detail {
namespace {

using opencascade::handle;

/// Clips a face's range to the geometry's: bounds of pcurves may stick out by rounding.
Interval clip(double lo, double hi, double first, double last, bool periodic, double period) {
  if (periodic) return hi - lo > period * (1.0 - 1e-9) ? Interval{lo, lo + period} : Interval{lo, hi};
  return {std::max(lo, first), std::min(hi, last)};
}

/// Partials of a cylinder, cone, sphere or torus; empty for other geometry.
///   S(u, v) = O + r(v) (cos u X + sin u Y) + z(v) Z                                                      (1)
/// cylinder (R, v), cone (R + v sin a, v cos a), sphere (R cos v, R sin v), torus (R + m cos v, m sin v).
/// Geom_Surface::DN is not used for them: in OpenCASCADE 7.6.3, DN(0, 1) of a cone lacks its part along the
/// axis, and fourth derivatives of a torus are wrong.
std::optional<SurfacePartials> turned_partials(const handle<Geom_Surface>& geometry, double u, double v) {
  using Profile = std::array<double, 5>;  // value and four derivatives
  Profile r{}, z{};
  const auto arc = [v](double centre, double radius) {
    const double c = radius * std::cos(v), s = radius * std::sin(v);
    return std::pair<Profile, Profile>{{centre + c, -s, -c, s, c}, {s, c, -s, -c, s}};
  };
  gp_Ax3 axes;
  if (const auto c = handle<Geom_CylindricalSurface>::DownCast(geometry)) {
    axes = c->Position();
    r[0] = c->Radius(), z[0] = v, z[1] = 1.0;
  } else if (const auto k = handle<Geom_ConicalSurface>::DownCast(geometry)) {
    axes = k->Position();
    r[1] = std::sin(k->SemiAngle()), z[1] = std::cos(k->SemiAngle());
    r[0] = k->RefRadius() + v * r[1], z[0] = v * z[1];
  } else if (const auto s = handle<Geom_SphericalSurface>::DownCast(geometry)) {
    axes = s->Position();
    std::tie(r, z) = arc(0.0, s->Radius());
  } else if (const auto t = handle<Geom_ToroidalSurface>::DownCast(geometry)) {
    axes = t->Position();
    std::tie(r, z) = arc(t->MajorRadius(), t->MinorRadius());
  } else {
    return std::nullopt;
  }
  const Vec3 X = vec(gp_Vec(axes.XDirection())), Y = vec(gp_Vec(axes.YDirection())),
             Z = vec(gp_Vec(axes.Direction()));
  const Vec3 e = std::cos(u) * X + std::sin(u) * Y, f = std::cos(u) * Y - std::sin(u) * X;
  const std::array<Vec3, 5> turn{e, f, -e, -f, e};  // derivatives of e by u
  SurfacePartials P;
  for (std::size_t n = 0; n <= 4; ++n)
    for (std::size_t j = 0; j <= n; ++j)
      P(static_cast<int>(n - j), static_cast<int>(j)) = r[j] * turn[n - j] + (n == j ? z[j] : 0.0) * Z;
  P(0, 0) += vec(axes.Location());
  return P;
}

using Jets = std::array<ModelJet, 3>;

/// The same surfaces as jets of models, with a plane among them; empty for other geometry.
std::optional<Jets> turned_jets(const handle<Geom_Surface>& geometry, const ModelJet& u, const ModelJet& v) {
  gp_Ax3 axes;
  ModelJet r, z(0.0);
  if (const auto p = handle<Geom_Plane>::DownCast(geometry)) {
    axes = p->Position();
  } else if (const auto c = handle<Geom_CylindricalSurface>::DownCast(geometry)) {
    axes = c->Position();
    r = ModelJet(c->Radius());
    z = v;
  } else if (const auto k = handle<Geom_ConicalSurface>::DownCast(geometry)) {
    axes = k->Position();
    r = k->RefRadius() + v * std::sin(k->SemiAngle());
    z = v * std::cos(k->SemiAngle());
  } else if (const auto s = handle<Geom_SphericalSurface>::DownCast(geometry)) {
    axes = s->Position();
    r = s->Radius() * cos(v);
    z = s->Radius() * sin(v);
  } else if (const auto t = handle<Geom_ToroidalSurface>::DownCast(geometry)) {
    axes = t->Position();
    r = t->MajorRadius() + t->MinorRadius() * cos(v);
    z = t->MinorRadius() * sin(v);
  } else {
    return std::nullopt;
  }
  const bool flat = geometry->IsKind(STANDARD_TYPE(Geom_Plane));
  const ModelJet x = flat ? u : r * cos(u), y = flat ? v : r * sin(u);
  const Vec3 O = vec(axes.Location()), X = vec(gp_Vec(axes.XDirection())), Y = vec(gp_Vec(axes.YDirection())),
             Z = vec(gp_Vec(axes.Direction()));
  Jets S;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto i = static_cast<Eigen::Index>(d);
    S[d] = O[i] + X[i] * x + Y[i] * y + Z[i] * z;
  }
  return S;
}

std::string lengths(const char* label, double x) { return std::string(label) + number_text(x, 6); }

}  // namespace

SurfaceJet OcctSurface::jet(UV p) const {
  gp_Pnt S;
  gp_Vec Su, Sv, Suu, Svv, Suv;
  const double sign = mirrored_ ? -1.0 : 1.0;
  geometry_->D2(p.u, sign * p.v, S, Su, Sv, Suu, Svv, Suv);
  return {vec(S), vec(Su), sign * vec(Sv), vec(Suu), sign * vec(Suv), vec(Svv)};
}

void OcctSurface::enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const {
  const TaylorModel turned_v = mirrored_ ? -v : v;
  const auto spline = handle<Geom_BSplineSurface>::DownCast(geometry_);
  if (const auto S = turned_jets(geometry_, ModelJet::u_variable(u), ModelJet::v_variable(turned_v))) {
    fill(out, *S);
  } else if (const auto ours = spline ? from_occt(spline) : std::nullopt) {
    ours->enclose(u, turned_v, out);
  } else {
    out.unproven = "a " + surface_kind(geometry_) + " surface of a STEP file has no enclosure";
    return;
  }
  if (!mirrored_) return;
  for (ModelVector* d : {&out.Sv, &out.Suv})
    for (TaylorModel& x : *d) x = -x;
}

SurfacePartials OcctSurface::partials(UV p) const {
  SurfacePartials P;
  const double sign = mirrored_ ? -1.0 : 1.0;
  const auto turned = turned_partials(geometry_, p.u, sign * p.v);
  for (int n = 0; n <= 4; ++n)
    for (int j = 0; j <= n; ++j) {
      const Vec3 d = turned   ? (*turned)(n - j, j)
                     : n == 0 ? vec(geometry_->Value(p.u, sign * p.v))
                              : vec(geometry_->DN(p.u, sign * p.v, n - j, j));
      P(n - j, j) = (j % 2 == 1 ? sign : 1.0) * d;
    }
  return P;
}

FaceGeometry face_geometry(const TopoDS_Face& face) {
  FaceGeometry f;
  f.geometry = BRep_Tool::Surface(face);
  while (const auto trimmed = handle<Geom_RectangularTrimmedSurface>::DownCast(f.geometry))
    f.geometry = trimmed->BasisSurface();
  f.reversed = face.Orientation() == TopAbs_REVERSED;
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0, g0 = 0, g1 = 0, h0 = 0, h1 = 0;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  f.geometry->Bounds(g0, g1, h0, h1);
  const bool up = f.geometry->IsUPeriodic(), vp = f.geometry->IsVPeriodic();
  const double pu = up ? f.geometry->UPeriod() : 0.0, pv = vp ? f.geometry->VPeriod() : 0.0;
  f.box.u = clip(u0, u1, g0, g1, up, pu);
  f.box.v = clip(v0, v1, h0, h1, vp, pv);
  f.box.u_closed = up && f.box.u.length() >= pu;
  f.box.v_closed = vp && f.box.v.length() >= pv;
  return f;
}

Surface oriented_surface(const FaceGeometry& face) {
  const auto spline = handle<Geom_BSplineSurface>::DownCast(face.geometry);
  if (spline && !face.reversed) {
    const auto whole = [](const Interval& a, const Interval& b) {
      return std::abs(a.lo - b.lo) + std::abs(a.hi - b.hi) <= 1e-9 * b.length();
    };
    const bool lines_inside =
        face.boundary && std::any_of(face.boundary->lines.begin(), face.boundary->lines.end(),
                                     [&](const BoundaryLine& line) { return !on_border(line, face.box); });
    if (const auto ours = from_occt(spline); ours && !lines_inside)
      if (whole(face.box.u, ours->domain().u) && whole(face.box.v, ours->domain().v)) return *ours;
  }
  SurfaceDomain box = face.box;
  if (face.reversed) box.v = mirrored(box.v);
  return OcctSurface(face.geometry, face.reversed, box, face.boundary);
}

std::string surface_kind(const handle<Geom_Surface>& geometry) {
  switch (GeomAdaptor_Surface(geometry).GetType()) {
    case GeomAbs_Plane:
      return "plane";
    case GeomAbs_Cylinder:
      return "cylinder";
    case GeomAbs_Cone:
      return "cone";
    case GeomAbs_Sphere:
      return "sphere";
    case GeomAbs_Torus:
      return "torus";
    case GeomAbs_BezierSurface:
    case GeomAbs_BSplineSurface:
      return "bspline";
    case GeomAbs_SurfaceOfRevolution:
      return "revolution";
    case GeomAbs_SurfaceOfExtrusion:
      return "extrusion";
    default:
      return "other";
  }
}

std::string size_text(const FaceGeometry& face) {
  const GeomAdaptor_Surface a(face.geometry);
  const double turn = Radians(face.box.u.length()).degrees(), along = face.box.v.length();
  switch (a.GetType()) {
    case GeomAbs_Plane:
      return number_text(face.box.u.length(), 6) + " x " + number_text(along, 6);
    case GeomAbs_Cylinder:
      return lengths("radius ", a.Cylinder().Radius()) + lengths(", length ", along) +
             lengths(", turn ", turn) + " deg";
    case GeomAbs_Cone: {
      const double slope = std::sin(a.Cone().SemiAngle()), r = a.Cone().RefRadius();
      return lengths("radius ", std::abs(r + face.box.v.lo * slope)) +
             lengths(" to ", std::abs(r + face.box.v.hi * slope)) +
             lengths(", half angle ", Radians(std::abs(a.Cone().SemiAngle())).degrees()) + " deg" +
             lengths(", turn ", turn) + " deg";
    }
    case GeomAbs_Sphere:
      return lengths("radius ", a.Sphere().Radius());
    case GeomAbs_Torus:
      return lengths("radii ", a.Torus().MajorRadius()) + lengths(" and ", a.Torus().MinorRadius());
    case GeomAbs_BSplineSurface:
      return "degree " + std::to_string(a.UDegree()) + " x " + std::to_string(a.VDegree()) + ", " +
             std::to_string(a.NbUPoles()) + " x " + std::to_string(a.NbVPoles()) + " control points";
    default:
      return "";
  }
}

std::optional<Vec2> elementary_parameters(const handle<Geom_Surface>& geometry, const Vec3& p) {
  double u = 0.0, v = 0.0;
  if (const auto g = handle<Geom_Plane>::DownCast(geometry))
    ElSLib::Parameters(g->Pln(), pnt(p), u, v);
  else if (const auto c = handle<Geom_CylindricalSurface>::DownCast(geometry))
    ElSLib::Parameters(c->Cylinder(), pnt(p), u, v);
  else if (const auto k = handle<Geom_ConicalSurface>::DownCast(geometry))
    ElSLib::Parameters(k->Cone(), pnt(p), u, v);
  else if (const auto s = handle<Geom_SphericalSurface>::DownCast(geometry))
    ElSLib::Parameters(s->Sphere(), pnt(p), u, v);
  else if (const auto t = handle<Geom_ToroidalSurface>::DownCast(geometry))
    ElSLib::Parameters(t->Torus(), pnt(p), u, v);
  else
    return std::nullopt;
  return Vec2(u, v);
}

Vec2 foot_near(const handle<Geom_Surface>& geometry, const Vec3& p, Vec2 uv) {
  for (int k = 0; k < 12; ++k) {
    gp_Pnt q;
    gp_Vec du, dv;
    geometry->D1(uv.x(), uv.y(), q, du, dv);
    const Vec3 a = vec(du), b = vec(dv), r = p - vec(q);
    const double E = a.dot(a), F = a.dot(b), G = b.dot(b), det = E * G - F * F;
    if (!(det > 1e-14 * E * G)) break;
    const Vec2 step((G * a.dot(r) - F * b.dot(r)) / det, (E * b.dot(r) - F * a.dot(r)) / det);
    uv += step;
    if (step.norm() <= 1e-15 * (1.0 + uv.norm())) break;
  }
  return uv;
}

bool same_elementary(const handle<Geom_Surface>& a, const handle<Geom_Surface>& b, double tolerance,
                     double size) {
  if (a->DynamicType() != b->DynamicType()) return false;
  // Points of one, within `size` of its origin and not all on one circle, must lie on the other.
  const bool angular = !a->IsKind(STANDARD_TYPE(Geom_Plane));
  const bool round =
      a->IsKind(STANDARD_TYPE(Geom_SphericalSurface)) || a->IsKind(STANDARD_TYPE(Geom_ToroidalSurface));
  for (const double u : {-1.0, -0.3, 0.4, 1.1, 2.5})
    for (const double v : {-1.0, 0.2, 0.9}) {
      const Vec3 p = vec(a->Value(angular ? u : u * size, round ? v : v * size));
      const auto uv = elementary_parameters(b, p);
      if (!uv || (vec(b->Value(uv->x(), uv->y())) - p).norm() > tolerance) return false;
    }
  return true;
}

}  // namespace blendwright::detail
