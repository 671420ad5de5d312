#pragma once
// The rows of this folder's families, group by group; distance_kinds() and solid_kinds() join them in this
// order.
#include "implicit/scene/node.hpp"

namespace blendwright::detail {

[[nodiscard]] std::span<const NodeKind> plane_kinds();           // plane, half_space, slab
[[nodiscard]] std::span<const NodeKind> superellipsoid_kinds();  // lp_metric, superquadric, asymmetric_...
[[nodiscard]] std::span<const NodeKind> generalized_kinds();     // generalized_distance
[[nodiscard]] std::span<const NodeKind> skeleton_kinds();        // segment_skeleton, capsule_gauge
[[nodiscard]] std::span<const NodeKind> sweep_kinds();  // polar_bar, sweep_line, sweep_arc, sweep_curve

[[nodiscard]] std::span<const NodeKind> quadric_kinds();  // quadric, ellipsoid_quadric, perturbation, freeform
[[nodiscard]] std::span<const NodeKind> solid_distance_kinds();  // sphere, ellipsoid, torus, box

}  // namespace blendwright::detail
