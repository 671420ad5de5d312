#pragma once
// From a checked spec to the shape: the functions behind the `make` column. Private to kernel/primitives.
#include "kernel/primitives/primary.hpp"
#include "kernel/primitives/quadrics.hpp"

namespace blendwright {

[[nodiscard]] Surface make_plane(const PrimarySpec& spec);
[[nodiscard]] Surface make_cylinder(const PrimarySpec& spec);
[[nodiscard]] Surface make_elliptic_cylinder(const PrimarySpec& spec);
[[nodiscard]] Surface make_cone(const PrimarySpec& spec);
[[nodiscard]] Surface make_elliptic_cone(const PrimarySpec& spec);
[[nodiscard]] Surface make_irregular_cone(const PrimarySpec& spec);
[[nodiscard]] Surface make_sphere(const PrimarySpec& spec);
[[nodiscard]] Surface make_ellipsoid(const PrimarySpec& spec);
[[nodiscard]] Surface make_torus(const PrimarySpec& spec);
[[nodiscard]] Surface make_elliptic_paraboloid(const PrimarySpec& spec);
[[nodiscard]] Surface make_hyperboloid_one_sheet(const PrimarySpec& spec);
[[nodiscard]] Surface make_hyperboloid_two_sheets(const PrimarySpec& spec);
[[nodiscard]] Surface make_revolution(const PrimarySpec& spec);
[[nodiscard]] Surface make_extrusion(const PrimarySpec& spec);
[[nodiscard]] Surface make_bspline(const PrimarySpec& spec);
[[nodiscard]] Surface make_formula(const PrimarySpec& spec);

/// The range of u (direction 0) or v (1): the given one, else the row's; nullopt when there is none.
[[nodiscard]] std::optional<Interval> range_of(const PrimarySpec& spec, const PrimaryInfo& row,
                                               std::size_t direction);
/// The ranges of a checked spec; closed where they turn fully or the spec says so.
[[nodiscard]] ShapeDomain domain_of(const PrimarySpec& spec);
/// A full turn, to rounding.
[[nodiscard]] bool is_full_turn(const Interval& range);

}  // namespace blendwright
