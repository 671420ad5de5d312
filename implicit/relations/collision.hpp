#pragma once
// Whether two solids have a point in common. Solids are closed: touching is contact.
#include "implicit/relations/search.hpp"

namespace blendwright {

enum class Contact { disjoint, contact, undecided };
[[nodiscard]] std::string_view name(Contact contact);

struct Collision {
  Contact contact = Contact::undecided;
  /// contact: a point of both solids, proven. Otherwise the point where the solids are nearest to each other,
  /// when one was found.
  std::optional<Vec3> point;
  std::optional<Vec3> normal;  ///< at point, unit, from the first solid to the second
  /// To first order, from the fields' gradients at point: > 0 the gap, < 0 minus the penetration (model
  /// units).
  std::optional<double> gap;
  std::size_t boxes = 0;         ///< examined
  std::optional<Box> undecided;  ///< encloses every undecided box
  std::vector<SearchCell> cells;
};

/// Bisects space where both solids may be. A box is left when a solid's range, or that of a convex
/// combination of both fields, is outside on it (Vyatkin 2014; corrected): mu phi_1 + (1 - mu) phi_2 < 0 has
/// no common point. On the way the stationary points of min(phi_1, phi_2) are found by Newton's method and
/// tried as witnesses. `start`: a point to try first, as the last contact of moving bodies. Throws InputError
/// ("tolerance", "domain": none is given and neither solid's bounds are known), Cancelled.
[[nodiscard]] Collision collide(const ScalarField& first, const ScalarField& second,
                                const SearchOptions& options, const std::optional<Vec3>& start = std::nullopt,
                                const Progress& progress = {});

/// The subdivision as printed: the view along `axis` (0, 1, 2) is cut into quarters, each a bar through the
/// whole depth of the domain, with the same tests (Vyatkin 2014). Bars cannot tell bodies apart that lie
/// behind each other: those end undecided at the tolerance.
[[nodiscard]] Collision collide_projected(const ScalarField& first, const ScalarField& second, int axis,
                                          const SearchOptions& options, const Progress& progress = {});

/// The same answer; for disjoint solids without a point also the place where they are nearest to each other,
/// as Newton's method finds it from between their bounds. Not when it finds none where the fields are smooth
/// and outside of both.
[[nodiscard]] Collision with_nearest_place(Collision collision, const ScalarField& first,
                                           const ScalarField& second);

}  // namespace blendwright
