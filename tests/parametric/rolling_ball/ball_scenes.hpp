#pragma once
// Primaries for rolling balls: solids by fields and by surfaces.
#include <array>
#include <string>
#include <vector>

#include "implicit/scene/scene.hpp"
#include "kernel/primitives/primary.hpp"
#include "parametric/rolling_ball/ball_surface.hpp"
#include "tests/implicit/support/scene_parts.hpp"
#include "tests/parametric/sample_lines.hpp"

namespace blendwright::test {

/// f >= 0 inside. Coefficients: x^2 y^2 z^2 xy xz yz x y z 1.
inline NodeSpec quadric(std::string name, std::vector<double> coefficients) {
  return part(std::move(name), "quadric", {{"coefficients", std::move(coefficients)}});
}
inline ScalarField field_of(std::vector<NodeSpec> nodes) {
  return build_scene(scene_of(std::move(nodes))).field;
}
inline ScalarField quadric_field(std::vector<double> coefficients) {
  return field_of({quadric("body", std::move(coefficients))});
}

/// 1 - sum ((x_i - c_i)/s_i)^2, times the smallest s^2.
inline std::vector<double> ellipsoid_coefficients(const Vec3& s, const Vec3& c) {
  const double k = s.minCoeff() * s.minCoeff();
  const Vec3 w = k * s.cwiseProduct(s).cwiseInverse();
  return {-w[0],
          -w[1],
          -w[2],
          0,
          0,
          0,
          2 * w[0] * c[0],
          2 * w[1] * c[1],
          2 * w[2] * c[2],
          k - w.dot(c.cwiseProduct(c))};
}
inline ScalarField ellipsoid_field(const Vec3& s, const Vec3& c) {
  return quadric_field(ellipsoid_coefficients(s, c));
}
inline ScalarField sphere_field(double R, const Vec3& c) { return ellipsoid_field({R, R, R}, c); }
/// The solid below z = height.
inline ScalarField floor_field(double height = 0.0) {
  return quadric_field({0, 0, 0, 0, 0, 0, 0, 0, -1, height});
}
/// Cylinder of this radius about the x axis (0), the y axis (1) or the z axis (2).
inline ScalarField cylinder_field(double radius, int axis) {
  std::vector<double> q{-1, -1, -1, 0, 0, 0, 0, 0, 0, radius * radius};
  q[static_cast<std::size_t>(axis)] = 0.0;
  return quadric_field(q);
}

inline Surface sphere_surface(double R, const Vec3& c) {
  PrimarySpec spec;
  spec.kind = "sphere";
  spec.numbers = {{"radius", R}};
  return primary_of(spec, RigidMotion{Eigen::Matrix3d::Identity(), c});
}
inline Surface ellipsoid_surface(const Vec3& s, const Vec3& c) {
  PrimarySpec spec;
  spec.kind = "ellipsoid";
  spec.numbers = {{"a", s[0]}, {"b", s[1]}, {"c", s[2]}};
  return primary_of(spec, RigidMotion{Eigen::Matrix3d::Identity(), c});
}
/// A primary of the surface whose outside is at this place.
inline BallPrimary outside_at(const Surface& surface, const Vec3& place) {
  const BallPrimary primary(surface);
  return BallPrimary(surface, primary.foot(place)->distance < 0.0);
}

inline Box cube(double half, const Vec3& c = Vec3::Zero()) {
  return {c - Vec3::Constant(half), c + Vec3::Constant(half)};
}
inline BallPair fillet(BallPrimary a, BallPrimary b, double r) {
  return {{std::move(a), std::move(b)}, {r, r}};
}
inline SpineSpec in_box(const Box& box) {
  SpineSpec spec;
  spec.box = box;
  return spec;
}

}  // namespace blendwright::test
