#pragma once
// Contacts among many moving bodies.
#include <span>

#include "implicit/relations/collision.hpp"
#include "kernel/field/rigid_motion.hpp"

namespace blendwright {

/// Two bodies (first < second) whose boxes meet, and what was found.
struct BodyPair {
  std::size_t first = 0, second = 0;
  Collision collision;
};

class MovingBodies {
 public:
  /// Each body in its own coordinates. Throws InputError ("bodies" when fewer than two, "bodies/i" when the
  /// bounds of one are not known or not finite, "tolerance").
  MovingBodies(std::vector<ScalarField> bodies, SearchOptions options);
  ~MovingBodies();
  MovingBodies(MovingBodies&&) noexcept;
  MovingBodies& operator=(MovingBodies&&) noexcept;

  [[nodiscard]] std::size_t size() const;
  /// All pairs that are in contact or undecided at these placements, one per body, ordered by (first,
  /// second); with `all` also the disjoint ones whose boxes meet, with the nearest place where one is at
  /// hand. Where a pair was in contact or nearest last time is where its decision starts now. Short of the
  /// work limit the answers do not depend on it, on the order of calls or on the number of threads: a contact
  /// is taken from there only when a whole cube of the tolerance's size is common, which no search can miss.
  /// Box counts and places may depend on the calls before. Throws InputError ("placements", or "placements/i"
  /// for one that is no rigid motion), Cancelled; nothing is remembered then.
  [[nodiscard]] std::vector<BodyPair> at(std::span<const RigidMotion> placements, bool all = false,
                                         const Progress& progress = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace blendwright
