#pragma once
// What a function does over a box to first order, with the rest as a range. Ranges alone lose that two
// functions change together; of these the linear parts can be added and cancel.
#include "kernel/field/range.hpp"

namespace blendwright {

/// Over a box with the centre c and half sizes h, at X = c + h t (componentwise), t in [-1, 1]^3:
/// f(X) lies in value + slope.t + rest. The slope is h times a gradient; rest contains 0 or not.
struct LinearBound {
  double value = 0.0;
  Vec3 slope = Vec3::Zero();
  Range rest;

  /// All values over the box, with what rounding of the sum can add.
  [[nodiscard]] Range range() const;
  /// The rest with both ends moved out by `slack`.
  [[nodiscard]] LinearBound widened(double slack) const {
    return {value, slope, {rest.lo - slack, rest.hi + slack}};
  }
  bool operator==(const LinearBound&) const = default;
};

/// A function of which only the range is known.
[[nodiscard]] LinearBound constant_bound(Range range);

// Both with what rounding can add.
[[nodiscard]] LinearBound operator+(const LinearBound& a, const LinearBound& b);
[[nodiscard]] LinearBound operator*(double factor, const LinearBound& a);

/// f - (value + slope.t) over the box.
[[nodiscard]] Range difference(const LinearBound& f, double value, const Vec3& slope);

}  // namespace blendwright
