#pragma once
// Linear bounds of gauges of profiles.
#include "implicit/primitives/norm_linear.hpp"
#include "implicit/primitives/profile.hpp"

namespace blendwright::detail {

/// g of the coordinates x, y. A rose or a star by Taylor's theorem: the second derivatives of g are (q +
/// q'')/r across the ray and 0 along it, so
///   g(P) = g(C) + grad g(C).(P - C) + B (across.(P - C))^2/2,  B in (q + q'')/r over the box.
/// The range where the axis is in the box, or a tip of a star with m < 2.
[[nodiscard]] BoundedNumber gauge_linear(const Profile& profile, const LinearInput& in);

}  // namespace blendwright::detail
