#pragma once
// Marching cubes as a table made by code: the triangles of a cell for every choice of inside corners.
//
// Corner c of a cell stands at (c & 1, c >> 1 & 1, c >> 2 & 1); case = sum of 2^c over the inside corners.
// Face rule: in every face, each run of inside corners around the face is cut off by a segment of its own, so
// inside corners that face each other across a diagonal are kept apart. The rule sees the face's corners
// only, so both cells of a face draw the same segments (in opposite directions): the surface is closed.
// The segments of a cell form loops; a loop is triangulated by chords that never lie in a face of the cell (a
// chord in a face could be drawn again by the neighbour). Such triangulations exist for all 256 cases; among
// them the one whose worst triangle is the least bent away from the loop is taken.
#include <array>
#include <cstdint>
#include <span>

namespace blendwright::detail {

struct CubeEdge {
  int axis = 0;
  std::array<int, 3> low{};  ///< its lower corner
};
/// Edge 4 axis + u + 2 v, where (u, v) are the coordinates of the other two axes in rising order.
inline constexpr std::array<CubeEdge, 12> cube_edges = [] {
  std::array<CubeEdge, 12> edges{};
  for (int axis = 0; axis < 3; ++axis)
    for (int uv = 0; uv < 4; ++uv) {
      CubeEdge& edge = edges[static_cast<std::size_t>(4 * axis + uv)];
      edge.axis = axis;
      edge.low[static_cast<std::size_t>(axis == 0 ? 1 : 0)] = uv & 1;
      edge.low[static_cast<std::size_t>(axis == 2 ? 1 : 2)] = uv >> 1;
    }
  return edges;
}();

/// Corners of the face at the low (side 0) or high (1) end of an axis, counter-clockwise seen from outside.
[[nodiscard]] constexpr std::array<int, 4> cube_face(int axis, int side) {
  const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, base = side << axis;
  return side == 1 ? std::array{base, base + u, base + u + v, base + v}
                   : std::array{base, base + v, base + u + v, base + u};
}
/// The edge between two neighbouring corners.
[[nodiscard]] constexpr int cube_edge_between(int a, int b) {
  const int low = a & b, axis = (a ^ b) == 1 ? 0 : (a ^ b) == 2 ? 1 : 2;
  const int u = axis == 0 ? low >> 1 & 1 : low & 1, v = axis == 2 ? low >> 1 & 1 : low >> 2 & 1;
  return 4 * axis + u + 2 * v;
}

using CubeTriangle = std::array<std::uint8_t, 3>;  ///< edges, counter-clockwise from outside the solid
[[nodiscard]] std::span<const CubeTriangle> cube_triangles(unsigned inside_corners);

/// The part of a cell's face that is inside, as triangles counter-clockwise seen from outside the cell, for a
/// face in the side of the box. Numbers 0..3: the face's corner; 4..7: the crossing between corners n - 4 and
/// n - 3 (cyclic). Bit n of the case: corner n is inside. Uses the face rule above.
[[nodiscard]] std::span<const CubeTriangle> square_triangles(unsigned inside_corners);

}  // namespace blendwright::detail
