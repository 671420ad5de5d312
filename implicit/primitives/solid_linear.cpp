#include "implicit/primitives/solid_linear.hpp"

#include <cmath>

#include "implicit/eval/linear_rules.hpp"
#include "implicit/primitives/solid_ranges.hpp"

namespace blendwright::detail {

LinearBound sphere_distance_linear(const void* body, const LinearInput& in) {
  return concave_bound(op_for<SphereDistance>(), body, in, static_cast<const SphereDistance*>(body)->radius);
}
LinearBound box_distance_linear(const void* body, const LinearInput& in) {
  return concave_bound(op_for<BoxDistance>(), body, in, static_cast<const BoxDistance*>(body)->half.norm());
}
LinearBound ellipsoid_distance_linear(const void* body, const LinearInput& in) {
  return concave_bound(op_for<EllipsoidDistance>(), body, in,
                       static_cast<const EllipsoidDistance*>(body)->s.maxCoeff());
}

/// With rho = |(x, y)| = rho_c + g.(y - c) + [0, E], p = rho - R and D = |(p, z)|, linear at the centre:
///   D >= D_c + D_p (p - p_c) + D_z (z - z_c) = line + D_p [0, E],
///   D <= |(p_c + g.(y - c), z)| + E, without E where p <= 0 all over the box, for D falls with p there;
/// the first term of the upper bound is convex, so it exceeds the line by most in a corner.
LinearBound torus_distance_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const TorusDistance*>(body);
  const Vec3& c = in.centre;
  const double rho = std::hypot(c.x(), c.y()), p = rho - b.ring, distance = std::hypot(p, c.z());
  const Vec3 across = rho > 0.0 ? Vec3(c.x() / rho, c.y() / rho, 0.0) : Vec3::Zero();
  const double dp = distance > 0.0 ? p / distance : 0.0, dz = distance > 0.0 ? c.z() / distance : 0.0;
  const Vec3 gradient = dp * across + Vec3(0.0, 0.0, dz);
  double bend = 0.0, excess = 0.0, farthest = 0.0;
  for (unsigned k = 0; k < 8; ++k) {
    const Vec3 y = in.corner(k), step = y - c;
    const double linear_p = p + across.dot(step), at = std::hypot(y.x(), y.y());
    bend = std::max(bend, at - b.ring - linear_p);
    excess = std::max(excess, std::hypot(linear_p, y.z()) - distance - gradient.dot(step));
    farthest = std::max(farthest, at);
  }
  const double upper = excess + (farthest <= b.ring ? 0.0 : bend), lower = std::min(0.0, dp) * bend;
  const double size = b.ring + b.tube + in.local.lo.cwiseAbs().cwiseMax(in.local.hi.cwiseAbs()).sum();
  return LinearBound{b.tube - distance, -in.slope(gradient), {-upper, -lower}}.widened(
      2.0 * distance_slack * size + 2.0 * in.slack.sum());
}

}  // namespace blendwright::detail
