#pragma once
// Components of the frame that share their cardinal functions; all three when the equation is isotropic.
#include <array>
#include <cmath>
#include <vector>

#include "parametric/ode/ode_blend.hpp"

namespace blendwright::detail {

/// Components first .. last - 1.
struct ComponentGroup {
  int first = 0, last = 3;
  /// Length of the part of x in these components.
  [[nodiscard]] double norm(const Vec3& x) const {
    double squares = 0.0;
    for (int i = first; i < last; ++i) squares += x[i] * x[i];
    return std::sqrt(squares);
  }
};

/// One number per cardinal function of a group.
using PerFunction = std::array<double, 6>;

[[nodiscard]] inline std::vector<ComponentGroup> component_groups(const OdeBlend& blend) {
  if (blend.order() == 6 || blend.shape().isotropic()) return {{0, 3}};
  return {{0, 1}, {1, 2}, {2, 3}};
}

}  // namespace blendwright::detail
