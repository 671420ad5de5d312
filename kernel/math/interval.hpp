#pragma once
// Interval arithmetic with outward rounding: a result always contains every value that exact arithmetic could
// give for operands within the given bounds.
//
//   a op b  in  [ down(min), up(max) ],   down(x) = x - 2^-52 |x| - 2^-1074,   up(x) = -down(-x) (1)
// + - * / and sqrt of IEEE 754 doubles are within half a unit in the last place of the exact value, and (1)
// steps out by at least one such unit, so that no rounding mode has to be switched. The elementary functions
// of the C library are taken as within 4 units in the last place (glibc documents at most 2); that is the one
// assumption made. Where a function is not defined, or a result overflows, the bounds are infinite or NaN:
// `finite()` tells. Source of the method: Moore, Kearfott, Cloud, Introduction to Interval Analysis, 2009,
// chapter 2.
#include <algorithm>
#include <cmath>
#include <limits>

namespace blendwright {

[[nodiscard]] inline double rounded_up(double x) {
  return x + (std::abs(x) * 0x1p-52 + std::numeric_limits<double>::denorm_min());
}
[[nodiscard]] inline double rounded_down(double x) { return -rounded_up(-x); }

/// Lower and upper bound of a number; lo <= hi, or not finite.
struct Bounds {
  double lo = 0.0, hi = 0.0;
  constexpr Bounds() = default;
  constexpr Bounds(double x) : lo(x), hi(x) {}  // NOLINT: numbers mix freely with bounds
  constexpr Bounds(double lo_, double hi_) : lo(lo_), hi(hi_) {}

  [[nodiscard]] bool finite() const { return std::isfinite(lo) && std::isfinite(hi); }
  [[nodiscard]] bool contains(double x) const { return lo <= x && x <= hi; }
  /// Largest and smallest absolute value.
  [[nodiscard]] double magnitude() const { return std::max(std::abs(lo), std::abs(hi)); }
  [[nodiscard]] double mignitude() const { return lo > 0.0 ? lo : (hi < 0.0 ? -hi : 0.0); }
  /// A double within, and a bound of the distance from it to any number within.
  [[nodiscard]] double middle() const { return lo == hi ? lo : 0.5 * lo + 0.5 * hi; }
  [[nodiscard]] double radius() const {
    const double m = middle();
    return lo == hi ? 0.0 : std::max(rounded_up(hi - m), rounded_up(m - lo));
  }
};

/// Everything: what is known of a quantity of which nothing is known.
[[nodiscard]] constexpr Bounds unbounded() {
  return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}
[[nodiscard]] inline Bounds outward(double lo, double hi) {
  if (std::isnan(lo) || std::isnan(hi)) return unbounded();
  return {rounded_down(lo), rounded_up(hi)};
}
/// A value of a C library function, widened by its assumed error.
[[nodiscard]] inline Bounds of_library(double x) {
  const double slack = 4.0 * (std::abs(x) * 0x1p-52 + std::numeric_limits<double>::denorm_min());
  return outward(x - slack, x + slack);
}

[[nodiscard]] inline Bounds hull(const Bounds& a, const Bounds& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}
[[nodiscard]] inline Bounds operator-(const Bounds& a) { return {-a.hi, -a.lo}; }
[[nodiscard]] inline Bounds operator+(const Bounds& a, const Bounds& b) {
  return outward(a.lo + b.lo, a.hi + b.hi);
}
[[nodiscard]] inline Bounds operator-(const Bounds& a, const Bounds& b) { return a + (-b); }
[[nodiscard]] inline Bounds operator*(const Bounds& a, const Bounds& b) {
  const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  if (std::isnan(p) || std::isnan(q) || std::isnan(r) || std::isnan(s)) return unbounded();
  return outward(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
}
[[nodiscard]] inline Bounds operator/(const Bounds& a, const Bounds& b) {
  if (!(b.lo > 0.0 || b.hi < 0.0)) return unbounded();
  const double p = a.lo / b.lo, q = a.lo / b.hi, r = a.hi / b.lo, s = a.hi / b.hi;
  if (std::isnan(p) || std::isnan(q) || std::isnan(r) || std::isnan(s)) return unbounded();
  return outward(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
}
/// a a: never negative, unlike the product of two unrelated numbers within the same bounds.
[[nodiscard]] inline Bounds square(const Bounds& a) {
  const double lo = a.mignitude(), hi = a.magnitude();
  return {std::max(rounded_down(lo * lo), 0.0), rounded_up(hi * hi)};
}
/// Of the part of `a` that is not negative; not finite when there is none.
[[nodiscard]] inline Bounds sqrt(const Bounds& a) {
  if (!(a.hi >= 0.0)) return unbounded();
  return {std::max(rounded_down(std::sqrt(std::max(a.lo, 0.0))), 0.0), rounded_up(std::sqrt(a.hi))};
}
[[nodiscard]] inline Bounds exp(const Bounds& a) {
  return {std::max(of_library(std::exp(a.lo)).lo, 0.0), of_library(std::exp(a.hi)).hi};
}
[[nodiscard]] inline Bounds log(const Bounds& a) {
  if (!(a.lo > 0.0)) return unbounded();
  return {of_library(std::log(a.lo)).lo, of_library(std::log(a.hi)).hi};
}
/// a^p of positive numbers.
[[nodiscard]] inline Bounds power(const Bounds& a, double p) {
  if (!(a.lo > 0.0)) return unbounded();
  return hull(of_library(std::pow(a.lo, p)), of_library(std::pow(a.hi, p)));
}
/// The angle of (x, y) with y, x >= 0: rises with y and falls with x.
[[nodiscard]] inline Bounds first_quadrant_angle(const Bounds& y, const Bounds& x) {
  if (std::isnan(y.hi) || std::isnan(x.lo)) return unbounded();
  return {std::max(of_library(std::atan2(std::max(y.lo, 0.0), std::max(x.hi, 0.0))).lo, 0.0),
          of_library(std::atan2(std::max(y.hi, 0.0), std::max(x.lo, 0.0))).hi};
}

}  // namespace blendwright
