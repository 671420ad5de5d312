#include "kernel/geometry/curvature.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace blendwright {
namespace {

constexpr double degenerate_sine = 1e-14;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Vec3 unit_normal(const SurfaceJet& jet) {
  const Vec3 n = jet.Su.cross(jet.Sv);
  const double W = n.norm();
  if (!(W > degenerate_sine * jet.Su.norm() * jet.Sv.norm())) return Vec3::Zero();
  return n / W;
}

SurfaceCurvature curvature(const SurfaceJet& jet) {
  const Vec3 n = unit_normal(jet);
  if (n.isZero(0.0)) return {nan, nan, nan, nan};
  const double E = jet.Su.squaredNorm(), f = jet.Su.dot(jet.Sv) / E, W2 = jet.Su.cross(jet.Sv).squaredNorm();
  const double L = jet.Suu.dot(n), M = jet.Suv.dot(n), N = jet.Svv.dot(n);
  // Second form in the orthonormal frame e1 = Su/|Su|, e2 = (Sv - f Su) sqrt(E)/W: symmetric, so that the
  // principal curvatures keep full accuracy at umbilics, where sqrt(H^2 - K) of (2) would lose half of the
  // digits.
  const double h11 = L / E, h12 = (M - f * L) / std::sqrt(W2), h22 = (N - 2.0 * f * M + f * f * L) * E / W2;
  const double H = 0.5 * (h11 + h22), r = std::hypot(0.5 * (h11 - h22), h12);
  return {H, h11 * h22 - h12 * h12, H - r, H + r};
}

double normal_curvature(const SurfaceJet& jet, const Vec3& direction, const Vec3& n) {
  const double E = jet.Su.squaredNorm(), F = jet.Su.dot(jet.Sv), G = jet.Sv.squaredNorm();
  const double W2 = jet.Su.cross(jet.Sv).squaredNorm();
  if (!(W2 > degenerate_sine * degenerate_sine * E * G)) return nan;
  const double du = jet.Su.dot(direction), dv = jet.Sv.dot(direction);
  const double a = (G * du - F * dv) / W2,
               b = (E * dv - F * du) / W2;  // direction = a Su + b Sv + normal part
  const double length2 = a * a * E + 2.0 * a * b * F + b * b * G;
  return (a * a * jet.Suu.dot(n) + 2.0 * a * b * jet.Suv.dot(n) + b * b * jet.Svv.dot(n)) / length2;  // (3)
}

Radians plane_angle(const Vec3& n1, const Vec3& n2) {
  return Radians(std::atan2(n1.cross(n2).norm(), std::abs(n1.dot(n2))));
}

}  // namespace blendwright
