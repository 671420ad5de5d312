#pragma once
// Points on grid edges: where a vertex starts, and where the surface crosses its edge.
#include <span>
#include <vector>

#include "implicit/polygonize/block_surface.hpp"
#include "kernel/field/scalar_field.hpp"

namespace blendwright::detail {

/// A vertex keeps at least this part of its edge's length from both ends, so that the triangles around a grid
/// point on the surface (or next to it) have area.
inline constexpr double edge_margin = 0.005;

/// Points in the layout that fields take.
struct Points {
  std::vector<double> x, y, z;
  void reserve(std::size_t n);
  void clear();
  void add(const Vec3& p);
  [[nodiscard]] std::size_t size() const { return x.size(); }
  [[nodiscard]] Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  [[nodiscard]] PointArrays arrays() const { return {x, y, z}; }
};

/// The crossing of a linear function with the values a and b at the ends, as a part of the edge within its
/// margins. Exactly one of a, b is > 0; either may be infinite.
[[nodiscard]] double linear_crossing(double a, double b);

/// The grid point at a corner of the block.
[[nodiscard]] Vec3 corner_point(const CellGrid& grid, const BlockPlace& place, int i, int j, int k);

/// All corners of the block, in the order of BlockPlace::corner.
[[nodiscard]] Points corner_points(const CellGrid& grid, const BlockPlace& place);

/// The point at part t of an edge of the block.
[[nodiscard]] Vec3 point_on_edge(const CellGrid& grid, const BlockPlace& place, const GridEdge& edge,
                                 double t);

/// For every edge the part t, within the margins, at which inside() changes sign: by regula falsi (Illinois)
/// with a bisection in every third step, until t is known to 1e-10. Where the field jumps this is the place
/// of the jump. Adds the number of points evaluated to `evaluated`.
[[nodiscard]] std::vector<double> edge_roots(const CellGrid& grid, const ScalarField::Model& model,
                                             Level level, const BlockPlace& place,
                                             std::span<const GridEdge> edges, std::size_t& evaluated);

}  // namespace blendwright::detail
