#pragma once
// What a field says of itself along a curve: its value and derivatives, enclosed in Taylor models.
//
// A model of a field (ScalarField::Model) that can also derives from EnclosedField. Without it nothing is
// known of the field's derivatives between points: boxes bound values only.
#include <array>

#include "kernel/geometry/enclosure.hpp"

namespace blendwright {

struct FieldEnclosure {
  TaylorModel value{};
  ModelVector gradient{};
  std::array<TaylorModel, 6> hessian{};  ///< xx, yy, zz, xy, xz, yz
};

class EnclosedField {
 public:
  virtual ~EnclosedField() = default;
  /// Contains the exact values along the curve at(x), x in [-1, 1]; unbounded where nothing is known.
  virtual void enclose(const ModelVector& at, FieldEnclosure& out) const = 0;
};

}  // namespace blendwright
