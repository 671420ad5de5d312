#pragma once
// Linear bounds of exact distances.
#include "implicit/primitives/solid_distance.hpp"

namespace blendwright::detail {

// Concave functions, see concave_bound.
[[nodiscard]] LinearBound sphere_distance_linear(const void* body, const LinearInput& in);
[[nodiscard]] LinearBound box_distance_linear(const void* body, const LinearInput& in);
[[nodiscard]] LinearBound ellipsoid_distance_linear(const void* body, const LinearInput& in);
/// The distance from the axis is convex in y, that from the circle convex in it and z.
[[nodiscard]] LinearBound torus_distance_linear(const void* body, const LinearInput& in);

}  // namespace blendwright::detail
