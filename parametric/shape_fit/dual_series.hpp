#pragma once
// Series along v with their derivatives by both tangent angles and by the map. Private to this module.
#include <array>
#include <cmath>

#include "kernel/geometry/series.hpp"

namespace blendwright::detail {

/// Derivatives by psi_0, psi_1 and g, each a series.
struct Dual {
  Series v;
  std::array<Series, 3> d{};
  Dual() = default;
  Dual(const Series& value) : v(value) {}  // NOLINT: constants mix freely
  Dual(double value) : v(value) {}         // NOLINT
};

inline Dual operator+(Dual a, const Dual& b) {
  a.v = a.v + b.v;
  for (std::size_t i = 0; i < 3; ++i) a.d[i] = a.d[i] + b.d[i];
  return a;
}
inline Dual operator-(Dual a, const Dual& b) {
  a.v = a.v - b.v;
  for (std::size_t i = 0; i < 3; ++i) a.d[i] = a.d[i] - b.d[i];
  return a;
}
inline Dual operator*(const Dual& a, const Dual& b) {
  Dual r(a.v * b.v);
  for (std::size_t i = 0; i < 3; ++i) r.d[i] = a.d[i] * b.v + a.v * b.d[i];
  return r;
}
inline Dual reciprocal(const Dual& a) {
  Dual r(1.0 / a.v);
  const Series slope = -(r.v * r.v);
  for (std::size_t i = 0; i < 3; ++i) r.d[i] = slope * a.d[i];
  return r;
}
inline Dual sqrt(const Dual& a) {
  Dual r(blendwright::sqrt(a.v));
  const Series slope = 0.5 / r.v;
  for (std::size_t i = 0; i < 3; ++i) r.d[i] = slope * a.d[i];
  return r;
}

// The same operations on bare series, where derivatives are not asked for.
inline const Series& value(const Series& a) { return a; }
inline const Series& value(const Dual& a) { return a.v; }
inline Series sqrt(const Series& a) { return blendwright::sqrt(a); }
inline Series reciprocal(const Series& a) { return blendwright::reciprocal(a); }

using Dual3 = std::array<Dual, 3>;
inline Dual3 operator+(const Dual3& a, const Dual3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Dual3 operator-(const Dual3& a, const Dual3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Dual3 operator*(const Dual& s, const Dual3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline Dual dot(const Dual3& a, const Dual3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace blendwright::detail
