#pragma once
// What a mesh needs in memory, and the refusal that names it.
#include <cstddef>

namespace blendwright::detail {

/// Bytes that a kept block takes while the mesh is made, without its vertices: signs and ranks of its
/// corners, its node and a shortened model (about twenty steps).
inline constexpr double bytes_per_block = 2048.0;
/// Points, normals, five columns, distance and slope of a vertex, its place on its edge and its component.
inline constexpr double bytes_per_vertex = 24 + 24 + 40 + 16 + 8 + 8;
inline constexpr double bytes_per_triangle = 12.0;
/// A flat piece of surface through a block of 8^3 cells crosses 8^2 edges of each axis at most, and has two
/// triangles per vertex.
inline constexpr double vertices_per_block = 128.0;

[[nodiscard]] constexpr double bytes_for(double blocks, double vertices, double triangles) {
  return blocks * bytes_per_block + vertices * bytes_per_vertex + triangles * bytes_per_triangle;
}
[[nodiscard]] constexpr double bytes_for_blocks(double blocks) {
  return bytes_for(blocks, blocks * vertices_per_block, 2.0 * blocks * vertices_per_block);
}

/// Throws InputError("max_memory") when `bytes` are more than `max_memory`. A mesh grows with the square of
/// 1 / cell, which gives the cell that would fit.
void require_memory(double bytes, std::size_t max_memory, double cell);

}  // namespace blendwright::detail
