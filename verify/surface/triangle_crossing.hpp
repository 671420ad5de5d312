#pragma once
// Do two triangles pass through each other?
#include <array>
#include <optional>

#include "kernel/base/units.hpp"

namespace blendwright::detail {

using Triangle = std::array<Vec3, 3>;

/// Where an edge of one triangle passes through the other.
struct Crossing {
  Vec3 point;
  double depth = 0.0;  ///< how far the nearer end of that edge lies beyond the other triangle, model units
  int triangle = 0;    ///< 0: the edge belongs to the first triangle, 1: to the second
  int edge = 0;        ///< from corner `edge` to the next one
  double along = 0.0;  ///< on that edge, in [0, 1]
};

/// The deepest crossing; empty when the triangles are apart or only touch. Lengths below `tolerance` are
/// zero: ends of edges that near to the other plane do not pass through it, triangles that thin pass through
/// nothing, triangles whose planes are that near are compared within their plane.
[[nodiscard]] std::optional<Crossing> crossing(const Triangle& a, const Triangle& b, double tolerance);

}  // namespace blendwright::detail
