#pragma once
// Gauss-Legendre quadrature.
#include <vector>

#include "kernel/base/units.hpp"

namespace blendwright {

struct QuadratureRule {
  std::vector<double> x, w;  ///< nodes and weights on [0, 1]
};
/// n-point rule, exact for polynomials of degree 2n - 1. n in [1, 64].
/// Throws InputError outside. Each rule is computed once, by Newton on the Legendre polynomial (error about
/// 1e-16).
[[nodiscard]] const QuadratureRule& gauss_legendre(int n);

}  // namespace blendwright
