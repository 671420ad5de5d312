#pragma once
// A mesh in the making: what the stages of polygonize() hand on.
#include <vector>

#include "implicit/polygonize/connectivity.hpp"
#include "implicit/polygonize/polygonize.hpp"
#include "implicit/polygonize/projection.hpp"

namespace blendwright::detail {

struct MeshDraft {
  const ScalarField& field;
  const CellGrid grid;
  const MeshOptions options;
  LiveBlocks live;
  std::vector<MeshBlock> blocks;  ///< as live.blocks
  TriMesh mesh;
  std::vector<double> value, distance;  ///< of the vertices; distance as in the column distance_error
  std::size_t surface_triangles = 0;    ///< the rest are the cap's
  MeshFacts facts;

  [[nodiscard]] bool cap() const { return options.at_box == MeshOptions::AtBox::cap; }
  [[nodiscard]] BlockField block_field(std::size_t block) const {
    return {grid, *live.blocks[block].model, field.level(), blocks[block].place};
  }
  /// Vertex v is at a point of the surface.
  void set_vertex(std::size_t v, const SurfacePoint& point);
};

/// Own edges with vertices, in the order of their numbers.
[[nodiscard]] std::vector<GridEdge> crossed_edges(const BlockSurface& surface);

/// Repairs faces that moving their vertices spoilt: with an area below 1e-9 cell^2, or turned against the
/// mean of their vertices' normals (of a cap: against the box's side). Such faces are slivers where the
/// surface passes close to a grid point, and faces at creases. In turn, for what is left: diagonals are
/// swapped; vertices take the crossings of their edges where those lie on the surface; vertices of faces
/// without area take their starts (the mesh of starts has no face without area). Counts faces that stay
/// turned in facts.turned_faces.
void repair(MeshDraft& draft);

/// Fills the columns named in polygonize().
void add_columns(MeshDraft& draft, const Progress& progress, double from, double to);

}  // namespace blendwright::detail
