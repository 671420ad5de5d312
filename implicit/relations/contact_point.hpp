#pragma once
// Private: where two solids are deepest in each other, or nearest.
#include <optional>

#include "implicit/relations/half.hpp"

namespace blendwright::detail {

/// A point X where the gradients g of both psi are opposite, and psi_1/|g_1| = psi_2/|g_2|: to first order
/// the middle of the gap, or of what both have in common.
struct ContactPoint {
  Vec3 point;
  double depth;   ///< the smaller psi there
  double v1, v2;  ///< both psi
  Vec3 g1, g2;    ///< their gradients
  bool settled;   ///< else a point on the way there
  /// First order: how far the surfaces are apart along the gradients, < 0 when the solids overlap.
  [[nodiscard]] double gap() const { return -(v1 / g1.norm() + v2 / g2.norm()); }
  /// Unit, from the first solid to the second: the mean of both surfaces' normals; nullopt without one.
  [[nodiscard]] std::optional<Vec3> normal() const;
};

/// Newton's method for (X, mu) from `start`, with psi and its derivatives divided by the present |g|:
///   [[mu H_1 + (1 - mu) H_2, g_1 - g_2], [(g_1 - g_2)^T, 0]] (dX, dmu)
///       = -(mu g_1 + (1 - mu) g_2, psi_1 - psi_2),
/// in steps no longer than `reach`. The matrix is inverted on its larger eigenspaces only (contact along a
/// curve or an area makes it singular): first almost all, then those above 0.05 of the largest. nullopt where
/// a value or gradient is not there.
[[nodiscard]] std::optional<ContactPoint> contact_point(const Half& first, const Half& second,
                                                        const Vec3& start, double reach);

/// A few steps of it, from a point that is near already.
[[nodiscard]] std::optional<ContactPoint> contact_point_near(const Half& first, const Half& second,
                                                             const Vec3& start, double reach, int steps);

/// Values and gradients of psi at a point, as of a contact.
[[nodiscard]] ContactPoint values_at(const Half& first, const Half& second, const Vec3& point);

}  // namespace blendwright::detail
