#include "kernel/primitives/primary_shapes.hpp"

#include <cmath>
#include <numbers>

#include "kernel/primitives/quadrics.hpp"

namespace blendwright {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

double number(const PrimarySpec& spec, const char* name) { return spec.numbers.at(name); }

}  // namespace

std::optional<Interval> range_of(const PrimarySpec& spec, const PrimaryInfo& row, std::size_t direction) {
  const std::optional<Interval>& given = direction == 0 ? spec.u : spec.v;
  return given ? given : row.domain[direction];
}

bool is_full_turn(const Interval& range) { return std::abs(range.length() - full_turn) <= 1e-12; }

ShapeDomain domain_of(const PrimarySpec& spec) {
  const PrimaryInfo& row = *find_primary(spec.kind);
  SurfaceDomain d{range_of(spec, row, 0).value(), range_of(spec, row, 1).value(), false, false};
  d.u_closed = (row.turns[0] && is_full_turn(d.u)) || spec.closed[0];
  d.v_closed = (row.turns[1] && is_full_turn(d.v)) || spec.closed[1];
  // Exactly one period, so that a parameter that is wrapped stays on the same point.
  if (row.turns[0] && d.u_closed) d.u.hi = d.u.lo + full_turn;
  if (row.turns[1] && d.v_closed) d.v.hi = d.v.lo + full_turn;
  return {d};
}

Surface make_plane(const PrimarySpec& s) { return Plane(PlaneShape{domain_of(s)}); }
Surface make_cylinder(const PrimarySpec& s) {
  return Cylinder(CylinderShape{domain_of(s), number(s, "radius")});
}
Surface make_elliptic_cylinder(const PrimarySpec& s) {
  return EllipticCylinder(EllipticCylinderShape{domain_of(s), number(s, "a"), number(s, "b")});
}
Surface make_cone(const PrimarySpec& s) {
  return Cone(ConeShape{domain_of(s), number(s, "radius"), degrees(number(s, "half_angle_deg"))});
}
Surface make_elliptic_cone(const PrimarySpec& s) {
  return EllipticCone(EllipticConeShape{domain_of(s), number(s, "a"), number(s, "b"), number(s, "height")});
}
Surface make_irregular_cone(const PrimarySpec& s) {
  return IrregularCone(IrregularConeShape{domain_of(s), number(s, "radius"), number(s, "height")});
}
Surface make_sphere(const PrimarySpec& s) { return Sphere(SphereShape{domain_of(s), number(s, "radius")}); }
Surface make_ellipsoid(const PrimarySpec& s) {
  return Ellipsoid(EllipsoidShape{domain_of(s), number(s, "a"), number(s, "b"), number(s, "c")});
}
Surface make_torus(const PrimarySpec& s) {
  return Torus(TorusShape{domain_of(s), number(s, "major_radius"), number(s, "minor_radius")});
}
Surface make_elliptic_paraboloid(const PrimarySpec& s) {
  return EllipticParaboloid(
      EllipticParaboloidShape{domain_of(s), number(s, "a"), number(s, "b"), number(s, "c")});
}
Surface make_hyperboloid_one_sheet(const PrimarySpec& s) {
  return HyperboloidOneSheet(
      HyperboloidOneSheetShape{domain_of(s), number(s, "a"), number(s, "b"), number(s, "c")});
}
Surface make_hyperboloid_two_sheets(const PrimarySpec& s) {
  return HyperboloidTwoSheets(
      HyperboloidTwoSheetsShape{domain_of(s), number(s, "a"), number(s, "b"), number(s, "c")});
}

}  // namespace blendwright
