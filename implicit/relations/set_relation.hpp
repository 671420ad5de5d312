#pragma once
// How two solids lie to each other as sets of points.
#include "implicit/relations/search.hpp"

namespace blendwright {

/// "The solid has no point." Throws like collide().
[[nodiscard]] Proof is_empty(const ScalarField& solid, const SearchOptions& options,
                             const Progress& progress = {});
/// "Every point of `inner` is in `outer`", proven by max min(phi_inner, -phi_outer) < 0, refuted by a point
/// of inner that is outside outer. Solids that touch from inside, or are equal, stay undecided.
[[nodiscard]] Proof is_inside(const ScalarField& inner, const ScalarField& outer,
                              const SearchOptions& options, const Progress& progress = {});
/// "No point is in both": the intersection predicate.
[[nodiscard]] Proof is_apart(const ScalarField& first, const ScalarField& second,
                             const SearchOptions& options, const Progress& progress = {});

struct SetRelation {
  enum class Kind { disjoint, first_inside_second, second_inside_first, overlapping, undecided };
  Kind kind = Kind::undecided;
  Proof first_empty, second_empty, apart, first_in_second, second_in_first;
};
[[nodiscard]] std::string_view name(SetRelation::Kind kind);
/// Overlapping: each has a point of its own and they have one in common. Every statement keeps its own proof.
[[nodiscard]] SetRelation set_relation(const ScalarField& first, const ScalarField& second,
                                       const SearchOptions& options, const Progress& progress = {});

}  // namespace blendwright
