#include "implicit/polygonize/connectivity.hpp"

#include "implicit/polygonize/cube_table.hpp"

namespace blendwright::detail {
namespace {

/// body(cell, ring, inside corners of the ring) for the faces of cells that lie in a side of the box and have
/// an inside corner.
template <class Body>
void for_each_side_square(const BlockPlace& place, const BlockSurface& surface, Body body) {
  for (std::size_t a = 0; a < 3; ++a)
    for (int side = 0; side < 2; ++side) {
      if (!(side == 0 ? place.at_low_side[a] : place.at_high_side[a])) continue;
      const std::array<int, 4> ring = cube_face(static_cast<int>(a), side);
      const std::size_t u = (a + 1) % 3, v = (a + 2) % 3;
      std::array<int, 3> cell{};
      cell[a] = side == 0 ? 0 : place.cells[a] - 1;
      for (cell[v] = 0; cell[v] < place.cells[v]; ++cell[v])
        for (cell[u] = 0; cell[u] < place.cells[u]; ++cell[u]) {
          unsigned inside = 0;
          for (unsigned n = 0; n < 4; ++n) {
            const int c = ring[n];
            const unsigned row = surface.row(cell[1] + (c >> 1 & 1), cell[2] + (c >> 2));
            inside |= (row >> (cell[0] + (c & 1)) & 1u) << n;
          }
          if (inside != 0) body(cell, ring, inside);
        }
    }
}

/// Segments of the face rule in a square: one for every run of inside corners.
std::size_t segments(unsigned inside) { return inside == 15u ? 0 : inside == 5u || inside == 10u ? 2 : 1; }

}  // namespace

void count_triangles(MeshBlock& block, bool cap) {
  block.surface.for_each_cell(
      [&](int, int, int, unsigned inside) { block.triangles += cube_triangles(inside).size(); });
  if (!block.place.at_side()) return;
  for_each_side_square(block.place, block.surface, [&](const auto&, const auto&, unsigned inside) {
    if (cap) block.cap_triangles += square_triangles(inside).size();
    block.rim_edges += segments(inside);
  });
}

Connector::Connector(const LiveBlocks& live, std::span<const MeshBlock> blocks, std::size_t block)
    : self_(blocks[block]) {
  for (std::uint32_t n = 0; n < 8; ++n) {
    GridIndex at = live.blocks[block].at;
    for (std::size_t a = 0; a < 3; ++a) at[a] += n >> a & 1u;
    if (const auto found = live.find(at)) near_[n] = &blocks[*found];
  }
}

const MeshBlock& Connector::owner(std::array<int, 3>& local) const {
  std::size_t beyond = 0;
  for (std::size_t a = 0; a < 3; ++a)
    if (local[a] >= self_.place.owned[a]) {
      local[a] = 0;  // the first corner of the neighbour is the last of this block
      beyond |= std::size_t{1} << a;
    }
  return *near_[beyond];
}

std::uint32_t Connector::edge_vertex(int i, int j, int k, int cube_edge) const {
  const CubeEdge& edge = cube_edges[static_cast<std::size_t>(cube_edge)];
  std::array local{i + edge.low[0], j + edge.low[1], k + edge.low[2]};
  const MeshBlock& block = owner(local);
  return block.first_vertex + block.surface.vertex({edge.axis, local[0], local[1], local[2]});
}

std::uint32_t Connector::cap_vertex(int i, int j, int k, int cube_corner) const {
  std::array local{i + (cube_corner & 1), j + (cube_corner >> 1 & 1), k + (cube_corner >> 2)};
  const MeshBlock& block = owner(local);
  return block.first_vertex + block.surface.cap_vertex(local[0], local[1], local[2]);
}

void Connector::write_surface(std::span<Triangle> out) const {
  std::size_t n = 0;
  self_.surface.for_each_cell([&](int i, int j, int k, unsigned inside) {
    for (const CubeTriangle& t : cube_triangles(inside))
      out[n++] = {edge_vertex(i, j, k, t[0]), edge_vertex(i, j, k, t[1]), edge_vertex(i, j, k, t[2])};
  });
}

void Connector::write_cap(std::span<Triangle> out) const {
  std::size_t n = 0;
  for_each_side_square(self_.place, self_.surface, [&](const auto& cell, const auto& ring, unsigned inside) {
    const auto vertex = [&](unsigned number) {
      const int corner = ring[number & 3u];
      if (number < 4) return cap_vertex(cell[0], cell[1], cell[2], corner);
      return edge_vertex(cell[0], cell[1], cell[2], cube_edge_between(corner, ring[(number + 1) & 3u]));
    };
    for (const CubeTriangle& t : square_triangles(inside))
      out[n++] = {vertex(t[0]), vertex(t[1]), vertex(t[2])};
  });
}

}  // namespace blendwright::detail
