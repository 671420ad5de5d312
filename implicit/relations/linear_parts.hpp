#pragma once
// Linear bounds of a field that is a tree of minima and maxima: what each of its leaves allows.
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/field/scalar_field.hpp"

namespace blendwright {

/// Over a box, f <= max over the alternatives of (min over the bounds of an alternative). A field without
/// minima and maxima has one alternative of one bound.
struct LinearParts {
  std::vector<LinearBound> bounds;
  std::vector<std::uint32_t> ends;  ///< alternative i: bounds [ends[i - 1], ends[i])

  [[nodiscard]] std::size_t alternatives() const { return ends.size(); }
  [[nodiscard]] std::span<const LinearBound> alternative(std::size_t i) const {
    const std::size_t first = i == 0 ? 0 : ends[i - 1];
    return std::span(bounds).subspan(first, ends[i] - first);
  }
};

/// Of f (sign 1) or of -f (sign -1). Models other than tapes are one part; so is a node of a tape that would
/// have more than a few alternatives, or very many bounds.
[[nodiscard]] LinearParts linear_parts(const ScalarField::Model& model, const Box& box, double sign);

}  // namespace blendwright
