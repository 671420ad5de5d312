#pragma once
// Private: one of the sets whose common point is looked for.
#include "kernel/field/scalar_field.hpp"

namespace blendwright::detail {

/// The solid of a field, closed (psi = phi >= 0), or what is outside of it (psi = -phi > 0).
struct Half {
  const ScalarField* field;
  bool outside = false;

  /// psi = sign() (f - surface value).
  [[nodiscard]] double sign() const { return outside ? -sense(field->level()) : sense(field->level()); }
  /// Exact in its sign: a difference of doubles rounds to 0 only when it is 0.
  [[nodiscard]] double psi(double value) const { return sign() * (value - surface_value(field->level())); }
  [[nodiscard]] Range psi(Range values) const {
    const double a = psi(values.lo), b = psi(values.hi);
    return sign() > 0.0 ? Range{a, b} : Range{b, a};
  }
  /// No value of the range belongs to the set.
  [[nodiscard]] bool excludes(Range psi_range) const {
    return psi_range.hi < 0.0 || (outside && psi_range.hi <= 0.0);
  }
  /// All do.
  [[nodiscard]] bool holds(Range psi_range) const {
    return psi_range.lo > 0.0 || (!outside && psi_range.lo >= 0.0);
  }
};

}  // namespace blendwright::detail
