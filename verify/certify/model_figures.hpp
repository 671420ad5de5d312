#pragma once
// Figures of a joint from models of vectors along it.
#include "kernel/geometry/enclosure.hpp"

namespace blendwright::detail {

/// What both contain; of bounds that do not meet, but for rounding, the gap between them.
[[nodiscard]] Bounds intersection(const Bounds& a, const Bounds& b);
/// Bounds of |x|: from the ranges of the coordinates, and from the model of |x|^2, which knows how they go
/// together.
[[nodiscard]] Bounds length(const ModelVector& x);
/// atan2(|a x b|, |a.b|), in [0, 90 deg].
[[nodiscard]] Bounds angle_between(const ModelVector& a, const ModelVector& b);
/// Normal curvature (3) of seam.hpp in the direction of the tangent plane nearest to t, about the unit normal
/// along n.
[[nodiscard]] TaylorModel curvature_along(const SurfaceEnclosure& s, const ModelVector& n,
                                          const ModelVector& t);

}  // namespace blendwright::detail
