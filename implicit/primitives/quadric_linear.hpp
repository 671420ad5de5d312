#pragma once
// Linear bounds of quadrics and perturbations.
#include "implicit/primitives/quadric.hpp"

namespace blendwright::detail {

/// The coefficients in t of a quadric at y = centre + axes t.
[[nodiscard]] QuadricCoefficients remapped(const QuadricCoefficients& a, const Vec3& centre,
                                           const Eigen::Matrix3d& axes);

/// Exact: A44' + (A14', A24', A34').t, and the quadratic terms as the rest, per axis and by the magnitudes of
/// the cross terms: the better of those along the box and those along the quadric's own axes, which for a
/// turned ellipsoid are none.
[[nodiscard]] LinearBound quadric_linear(const void* body, const LinearInput& in);
/// With q = q0 + q1.t + rest and p = max(q0 + c, 0): w (p^k + k p^(k-1) (q - q0) + [0, d]); the power is
/// convex, so d is its largest distance from the tangent, at an end of q's range.
[[nodiscard]] LinearBound perturbation_linear(const void* body, const LinearInput& in);
[[nodiscard]] LinearBound added_perturbation_linear(const void* body, const LinearInput& in);
[[nodiscard]] LinearBound added_quadric_linear(const void* body, const LinearInput& in);

}  // namespace blendwright::detail
