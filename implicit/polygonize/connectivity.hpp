#pragma once
// Triangles of a block, with vertices numbered through the whole mesh.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "implicit/polygonize/block_surface.hpp"
#include "implicit/polygonize/block_tree.hpp"

namespace blendwright::detail {

/// A kept block with its part of the mesh. Vertices of the mesh stand block by block: those on edges, then
/// those of the cap; triangles: those of the surface block by block, then those of the cap block by block.
struct MeshBlock {
  BlockPlace place;
  BlockSurface surface;
  std::vector<double> start;  ///< part of its edge at which each edge vertex starts
  std::uint32_t first_vertex = 0;
  std::size_t triangles = 0, cap_triangles = 0, first_triangle = 0, first_cap_triangle = 0;
  std::size_t rim_edges = 0;  ///< edges of surface triangles that lie in the box's sides
  std::size_t evaluated = 0;  ///< points
};

using Triangle = std::array<std::uint32_t, 3>;

/// Fills in the numbers of triangles (no cap: cap_triangles stays 0) and of rim edges.
void count_triangles(MeshBlock& block, bool cap);

/// Writes triangles with the numbers of their vertices; a vertex on the far side of the block belongs to a
/// neighbour.
class Connector {
 public:
  Connector(const LiveBlocks& live, std::span<const MeshBlock> blocks, std::size_t block);
  void write_surface(std::span<Triangle> out) const;
  void write_cap(std::span<Triangle> out) const;

 private:
  [[nodiscard]] const MeshBlock& owner(std::array<int, 3>& local) const;
  [[nodiscard]] std::uint32_t edge_vertex(int i, int j, int k, int cube_edge) const;
  [[nodiscard]] std::uint32_t cap_vertex(int i, int j, int k, int cube_corner) const;
  const MeshBlock& self_;
  std::array<const MeshBlock*, 8> near_{};  ///< the neighbours towards higher indices; bit a: along axis a
};

}  // namespace blendwright::detail
