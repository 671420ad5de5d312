#include "kernel/geometry/rigid_motion.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/geometry/enclosure.hpp"

namespace blendwright {
namespace {

constexpr double parallel_sine = 1e-9;  // below, the perpendicular part of x_direction is mostly rounding

Vec3 perpendicular_part(const Vec3& x, const Vec3& unit_z) { return x - x.dot(unit_z) * unit_z; }

}  // namespace

RigidMotion RigidMotion::from_axis(const Vec3& origin, const Vec3& direction, const Vec3& x_direction) {
  const double length = direction.norm();
  if (!(length > 0.0) || !std::isfinite(length))
    throw InputError("direction", "must be a finite vector that is not zero");
  if (!origin.allFinite()) throw InputError("origin", "must be finite");
  if (!x_direction.allFinite()) throw InputError("x_direction", "must be finite");
  const Vec3 z = direction / length;
  Vec3 x;
  if (x_direction.isZero(0.0)) {
    // The axis that leaves more of itself perpendicular to z; the change from x to y happens far from both.
    x = perpendicular_part(std::abs(z.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY(), z);
  } else {
    x = perpendicular_part(x_direction.normalized(), z);
    if (!(x.norm() > parallel_sine)) throw InputError("x_direction", "is parallel to direction, must not be");
  }
  x.normalize();
  x = perpendicular_part(x, z).normalized();  // once more: the first pass leaves rounding / |x| along z
  RigidMotion motion;
  motion.R.col(0) = x;
  motion.R.col(1) = z.cross(x);
  motion.R.col(2) = z;
  motion.t = origin;
  return motion;
}

SurfaceJet PlacedSurface::jet(UV p) const {
  const SurfaceJet j = shape.jet(p);
  return {motion(j.S),      motion.R * j.Su,  motion.R * j.Sv,
          motion.R * j.Suu, motion.R * j.Suv, motion.R * j.Svv};
}

SurfacePartials PlacedSurface::partials(UV p) const {
  SurfacePartials partials = shape.partials(p);
  for (Vec3& d : partials.d) d = (motion.R * d).eval();
  partials(0, 0) += motion.t;
  return partials;
}

void PlacedSurface::enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const {
  if (!shape.enclose(u, v, out)) out.unproven = "its shape has no enclosure";
  for (ModelVector* x : {&out.S, &out.Su, &out.Sv, &out.Suu, &out.Suv, &out.Svv}) *x = turned(motion.R, *x);
  out.S = out.S + constant_model(motion.t);
}

Surface placed(const Surface& shape, const RigidMotion& motion) {
  if (motion.is_identity()) return shape;
  if (const auto* inner = shape.target<PlacedSurface>())
    return placed(inner->shape, {motion.R * inner->motion.R, motion(inner->motion.t)});
  return PlacedSurface{shape, motion};
}

}  // namespace blendwright
