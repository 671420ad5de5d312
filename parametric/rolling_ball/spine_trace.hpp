#pragma once
// Follows a spine from one ball. Private to this module.
#include "parametric/rolling_ball/ball_contact.hpp"

namespace blendwright {

/// All of a spine point but s.
[[nodiscard]] SpinePoint spine_point(const BallPair& pair, const BallContact& contact);

/// The spec with its defaults filled in.
[[nodiscard]] SpineSpec checked(const BallPair& pair, const SpineSpec& spec);

[[nodiscard]] BallFailure failure(BallFailure::Cause cause, const BallPair& pair, const Vec3& at);

/// The component through `start`, whose centre is in the box; nullopt when it is a single place (a spine that
/// has shrunk to a point).
[[nodiscard]] std::optional<Spine> traced(const BallPair& pair, const SpineSpec& spec,
                                          const BallContact& start);

}  // namespace blendwright
