#pragma once
// The generalized distance function: d = N_n(|X.n_1|, ..., |X.n_k|), N_n the overflow-safe p-norm; n_i unit
// normals, n >= 1, k >= 1; X in R^3, d in units of X. k normals give 2k facets, sharper with larger n (the
// polyhedron max |X.n_i| = 1 for n -> inf). Ray-linear and convex; d > 0 off the origin, and the level sets
// bounded, if and only if the normals span R^3. Gradient sum (|y_i|/d)^(n-1) sign(y_i) n_i, y_i = X.n_i.
// Akleman and Chen 1999. Erratum: a stray bar stands before the bracket of the printed sum.
// Range: upper end exact (a corner, d is convex); lower end the larger of N_n over the ranges of |y_i| and of
// the tangent plane in the box's middle, which a convex function never goes below.
#include <vector>

#include "implicit/eval/op.hpp"
#include "implicit/number/power.hpp"

namespace blendwright::detail {

struct GeneralizedDistance {
  std::vector<Vec3> normals;
  Power n, inverse_n;
};

/// Whether the unit normals span R^3: no plane through the origin has all of them within 1e-6.
[[nodiscard]] bool span_space(const std::vector<Vec3>& normals);
/// Half the size of a box around d <= 1, for normals that span R^3.
[[nodiscard]] Vec3 half_size(const GeneralizedDistance& body);

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::GeneralizedDistance>();
}  // namespace blendwright
