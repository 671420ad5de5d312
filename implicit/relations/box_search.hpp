#pragma once
// Private: the one search behind all relations. Looks for a point that lies in one or two half solids at
// once.
#include <span>

#include "implicit/relations/contact_point.hpp"
#include "implicit/relations/half.hpp"
#include "implicit/relations/search.hpp"

namespace blendwright::detail {

/// Where a common point can be: the box to look in and the bounds of the solids; nullopt: nowhere. Throws
/// InputError ("tolerance", "domain").
[[nodiscard]] std::optional<Box> search_domain(std::span<const Half> halves, const SearchOptions& options);

/// Proof that the point belongs to all: the ranges of the fields at that very point.
[[nodiscard]] bool common(std::span<const Half> halves, const Vec3& point);

struct Found {
  Proof proof;  ///< of "there is no common point"
  /// Of two: the deepest settled point that was met.
  std::optional<ContactPoint> nearest;
};

/// Boxes are examined and halved across their longest edge, those that may hold the deepest common point
/// first. A box is left
///   - when the range of a psi is < 0 on it;
///   - when a convex combination of linear bounds of the psi, or of the leaves of their minima and maxima, is
///     < 0 on it: each psi >= 0 at a common point. All alternatives of maxima must be refuted.
/// What is left is cut down to where single linear bounds allow a common point (not with depth_axis).
/// The point where the linear bounds are highest is tried as a witness, and Newton's method from there now
/// and then; a witness counts when the ranges of the fields at that very point say so.
/// start: tried first. depth_axis 0, 1, 2: boxes are quartered across the other two axes only, never along
/// this one.
[[nodiscard]] Found find_common_point(std::span<const Half> halves, const Box& domain,
                                      const SearchOptions& options, const Progress& progress,
                                      const std::optional<Vec3>& start = std::nullopt,
                                      std::optional<int> depth_axis = std::nullopt);

}  // namespace blendwright::detail
