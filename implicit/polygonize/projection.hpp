#pragma once
// Moves vertices from their places on grid edges to the surface.
#include <cstdint>
#include <span>
#include <vector>

#include "implicit/polygonize/edge_roots.hpp"

namespace blendwright::detail {

/// What is known of a vertex: its place, the field's value and gradient there.
struct SurfacePoint {
  Vec3 at = Vec3::Zero(), gradient = Vec3::Zero();
  double value = 0.0;
};

/// A block's share of a mesh in the making.
struct BlockField {
  const CellGrid& grid;
  const ScalarField::Model& model;  ///< valid in the block's box grown by half a cell
  Level level;
  const BlockPlace& place;
};

/// Value and gradient at points.
[[nodiscard]] std::vector<SurfacePoint> measured(const BlockField& block, const Points& points,
                                                 std::size_t& evaluated);

/// For every edge (with its start at part t of it) at most `newton_steps` damped Newton steps
///   p <- p - lambda phi(p) g / |g|^2,   phi = inside(), g its gradient,   lambda = 1, 1/2, 1/4, ...     (1)
/// that stay within half a cell of the start and in the grid's box; a step counts when |phi| falls. A vertex
/// on a side (or an edge) of the grid's box stays on it: g loses its components across. Vertices that are not
/// within 1e-7 cell of the surface to first order after that take the crossing of their edge instead, when
/// |phi| is smaller there, and up to eight more steps (1) where that is not on the surface either (it passes
/// a grid point closer than the margin of the edge). No steps: the starts themselves.
[[nodiscard]] std::vector<SurfacePoint> project(const BlockField& block, std::span<const GridEdge> edges,
                                                std::span<const double> t, int newton_steps,
                                                std::size_t& evaluated);

/// The point is within 1e-7 cell of the surface to first order.
[[nodiscard]] bool reached(const BlockField& block, const SurfacePoint& point);

/// The crossings of the edges themselves.
[[nodiscard]] std::vector<SurfacePoint> crossings(const BlockField& block, std::span<const GridEdge> edges,
                                                  std::size_t& evaluated);

}  // namespace blendwright::detail
