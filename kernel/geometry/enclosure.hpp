#pragma once
// What surfaces and curves say of themselves between the samples: enclosures along one piece of a parameter.
//
// A surface or curve that has a member
//     void enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const;
//     void enclose(const TaylorModel& v, CurveEnclosure& out) const;
// is provable: it fills in models that contain the exact values for every x in [-1, 1], where u(x), v(x) is
// the curve through its domain. A component of which nothing is known is unbounded. Without the member, or
// with a reason given, nothing is proven.
#include <array>
#include <string>
#include <utility>

#include "kernel/base/units.hpp"
#include "kernel/math/model_jet.hpp"

namespace blendwright {

using ModelVector = std::array<TaylorModel, 3>;

struct SurfaceEnclosure {
  ModelVector S{}, Su{}, Sv{}, Suu{}, Suv{}, Svv{};
  std::string unproven{};  ///< why there is no enclosure; empty: there is one
};

/// D[k][d]: d-th coordinate of the k-th derivative with respect to the curve's parameter, k = 0..2.
struct CurveEnclosure {
  std::array<ModelVector, 3> D{};
  std::string unproven{};
};

[[nodiscard]] inline ModelVector operator+(const ModelVector& a, const ModelVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
[[nodiscard]] inline ModelVector operator-(const ModelVector& a, const ModelVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
[[nodiscard]] inline ModelVector operator*(const TaylorModel& s, const ModelVector& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
[[nodiscard]] inline TaylorModel dot(const ModelVector& a, const ModelVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline ModelVector cross(const ModelVector& a, const ModelVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
[[nodiscard]] inline ModelVector constant_model(const Vec3& x) { return {x[0], x[1], x[2]}; }
[[nodiscard]] inline ModelVector unknown_vector() {
  return {TaylorModel::unknown(), TaylorModel::unknown(), TaylorModel::unknown()};
}

/// Values and derivatives from the coefficients of three jets.
void fill(SurfaceEnclosure& out, const std::array<ModelJet, 3>& s);
/// The same of a curve evaluated in the first variable.
template <std::size_t Dim>
void fill(CurveEnclosure& out, const std::array<ModelJet, Dim>& s) {
  for (std::size_t d = 0; d < Dim; ++d) {
    out.D[0][d] = s[d].c[0];
    out.D[1][d] = s[d].c[1];
    out.D[2][d] = 2.0 * s[d].c[3];
  }
}

/// d/dx and d2/dx2 of S(u(x), v(x)) for derivatives of u and v by the same parameter.
[[nodiscard]] ModelVector velocity(const SurfaceEnclosure& s, const CurveEnclosure& uv);
[[nodiscard]] ModelVector acceleration(const SurfaceEnclosure& s, const CurveEnclosure& uv);

/// x -> R x + t on values, R on derivatives.
[[nodiscard]] ModelVector turned(const Eigen::Matrix3d& R, const ModelVector& x);

}  // namespace blendwright
