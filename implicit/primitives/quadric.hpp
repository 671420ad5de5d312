#pragma once
// Quadrics and perturbation functions, F-representation: the solid is f >= 0 (Vyatkin 2007-2014).
//   Q(X) = A11 x^2 + A22 y^2 + A33 z^2 + A12 xy + A13 xz + A23 yz + A14 x + A24 y + A34 z + A44      (1)
//   R(X) = w max(q + c, 0)^k,  k >= 2 an integer, w != 0: a bump for w > 0, a dent for w < 0          (2)
//   F'(X) = F(X) + sum R_i(X)                                                                         (3)
// Coefficients in the order A11 A22 A33 A12 A13 A23 A14 A24 A34 A44; cross terms are whole (no hidden factor
// 2). R is C^(k-1) and not C^k where q = 0. Errata: the printed (3) has no weight and could only add.
#include <array>
#include <optional>

#include "implicit/eval/op.hpp"

namespace blendwright::detail {

using QuadricCoefficients = std::array<double, 10>;

/// (1), in local coordinates up to 1e120 in magnitude, coefficients up to 1e60: no product overflows.
struct Quadric {
  explicit Quadric(const QuadricCoefficients& coefficients)
      : a(coefficients), crossed(a[3] != 0.0 || a[4] != 0.0 || a[5] != 0.0) {}
  QuadricCoefficients a;
  bool crossed;  ///< whether there are terms xy, xz or yz
};
/// (2) of its one argument q; k = power, c = free_term: grows or shrinks the support and the height.
struct Perturbation {
  double weight = 1.0;
  int power = 3;
  double free_term = 0.0;
};
/// One term of (3): its arguments are the sum so far, and q.
struct AddedPerturbation {
  Perturbation added;
};
/// One term of (3) with a quadric q, in local coordinates: its argument is the sum so far.
struct AddedQuadric {
  Quadric q;
  Perturbation added;
};
/// The sum of its two arguments.
struct Sum {};

/// The coefficients in t, X = centre + half * t componentwise, t in [-1, 1]^3.
[[nodiscard]] QuadricCoefficients remapped(const QuadricCoefficients& a, const Vec3& centre,
                                           const Vec3& half);
// The values of a quadric over [-1, 1]^3, three enclosures of rising cost and each inside the one before;
// without rounding (see quadric_range).
/// A44 -+ the sum of the magnitudes of all others.
[[nodiscard]] Range sum_bound(const QuadricCoefficients& a);
/// Exact per axis, magnitudes of the cross terms: exact when there are none.
[[nodiscard]] Range tight_bound(const QuadricCoefficients& a);
/// Exact: the stationary points of the inside, the faces, edges and corners.
[[nodiscard]] Range exact_range(const QuadricCoefficients& a);
/// tight_bound over a box, with what rounding can add: 32 units of round-off of the terms' magnitudes there.
[[nodiscard]] Range quadric_range(const QuadricCoefficients& a, const Box& box);

/// The coefficients in X of the quadric that has the coefficients `a` in frame.local(X).
[[nodiscard]] QuadricCoefficients seen_through(const QuadricCoefficients& a, const Frame& frame);
/// The largest value of a quadric whose quadratic part is negative definite (ellipsoids), and where it is;
/// nullopt for all others, and where the ratio of the axes is beyond 1e6.
struct QuadricTop {
  Vec3 at = Vec3::Zero();
  double value = 0.0;
  Vec3 reach = Vec3::Zero();  ///< half of the box of {Q >= value - 1}, around `at`
  double uncertainty = 0.0;   ///< of all three, relative to the terms that they are made of
};
[[nodiscard]] std::optional<QuadricTop> top_of(const QuadricCoefficients& a);
/// Encloses { Q >= value }; the point of the top when that is empty. Of quadrics without cross terms also where
/// only some directions are bounded (ends may be infinite); nullopt: unbounded, or not known.
[[nodiscard]] std::optional<Box> quadric_region(const QuadricCoefficients& a, double value);

}  // namespace blendwright::detail

namespace blendwright {
template <>
const Op& op_for<detail::Quadric>();
template <>
const Op& op_for<detail::Perturbation>();
template <>
const Op& op_for<detail::AddedPerturbation>();
template <>
const Op& op_for<detail::AddedQuadric>();
template <>
const Op& op_for<detail::Sum>();
}  // namespace blendwright
