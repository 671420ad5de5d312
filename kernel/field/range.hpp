#pragma once
// Ranges of values and boxes of space: what bounds are made of.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "kernel/base/units.hpp"

namespace blendwright {

/// All values between lo and hi, ends included; infinite ends are allowed. lo == hi: exactly that value.
struct Range {
  double lo = 0.0, hi = 0.0;
  [[nodiscard]] constexpr bool contains(double x) const { return x >= lo && x <= hi; }
  [[nodiscard]] constexpr bool constant() const { return lo == hi; }
  [[nodiscard]] static constexpr Range everything() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  /// The range with both ends moved out by `relative` of their own size: what rounding can add. Zero and
  /// infinity stay.
  [[nodiscard]] Range widened(double relative) const {
    const double infinity = std::numeric_limits<double>::infinity();
    return {lo == infinity ? lo : lo - relative * std::abs(lo),
            hi == -infinity ? hi : hi + relative * std::abs(hi)};
  }
  bool operator==(const Range&) const = default;
};

/// The range of |x| for x in r.
[[nodiscard]] inline Range magnitude(Range r) {
  if (r.lo >= 0.0) return r;
  if (r.hi <= 0.0) return {-r.hi, -r.lo};
  return {0.0, std::max(-r.lo, r.hi)};
}

/// An axis-aligned box, lo <= hi in every coordinate.
struct Box {
  Vec3 lo = Vec3::Zero(), hi = Vec3::Zero();
  [[nodiscard]] Vec3 centre() const { return 0.5 * (lo + hi); }
  [[nodiscard]] Vec3 size() const { return hi - lo; }
  [[nodiscard]] Range axis(int i) const { return {lo[i], hi[i]}; }
  [[nodiscard]] bool contains(const Vec3& p) const {
    return (p.array() >= lo.array()).all() && (p.array() <= hi.array()).all();
  }
  [[nodiscard]] bool finite() const { return lo.allFinite() && hi.allFinite(); }
  bool operator==(const Box&) const = default;
};

/// The smallest box around both.
[[nodiscard]] inline Box hull(const Box& a, const Box& b) {
  return {a.lo.cwiseMin(b.lo), a.hi.cwiseMax(b.hi)};
}
/// What both boxes have in common, if anything.
[[nodiscard]] inline std::optional<Box> common(const Box& a, const Box& b) {
  const Box box{a.lo.cwiseMax(b.lo), a.hi.cwiseMin(b.hi)};
  if ((box.lo.array() > box.hi.array()).any()) return std::nullopt;
  return box;
}

}  // namespace blendwright
