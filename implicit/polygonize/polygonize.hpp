#pragma once
// The surface of a field as a triangle mesh.
#include <cstdint>
#include <optional>

#include "kernel/base/progress.hpp"
#include "kernel/field/scalar_field.hpp"
#include "kernel/mesh/mesh.hpp"

namespace blendwright {

struct MeshOptions {
  double cell = 0.0;       ///< edge length of a cell (model units), > 0
  std::optional<Box> box;  ///< what is meshed; none: the field's bounds with a margin of a cell
  /// Where the solid leaves the box: closed by faces in the box's sides, or left open.
  enum class AtBox { cap, open } at_box = AtBox::cap;
  int newton_steps = 2;                           ///< damped steps of every vertex towards the surface
  std::size_t max_memory = std::size_t{4} << 30;  ///< bytes; refused before it is exceeded
  bool columns = true;                            ///< fill the columns below
};

/// What a mesh and its making look like. Lengths in model units.
struct MeshFacts {
  std::size_t cells[3] = {0, 0, 0};  ///< of the whole grid
  std::size_t live_blocks = 0;       ///< blocks that ranges could not rule out
  std::size_t evaluated_points = 0;  ///< of any order
  std::size_t vertices = 0, triangles = 0;
  bool cut_by_box = false;                             ///< the solid reaches the box
  double largest_distance = 0.0, mean_distance = 0.0;  ///< |value - level| / |gradient| at the vertices
  std::size_t without_normal = 0;                      ///< vertices where the gradient vanishes
  std::size_t turned_faces = 0;                        ///< faces that point against their vertices' normals
  double area = 0.0, volume = 0.0;                     ///< volume is meaningful for a closed mesh
  long euler_characteristic = 0;                       ///< vertices - edges + faces
  std::size_t components = 0;
};

struct FieldMesh {
  TriMesh mesh;  ///< outward normals; triangles counter-clockwise from outside
  MeshFacts facts;
};

/// Marching cubes on blocks of 8^3 cells that the surface can meet, found by descending from the whole box
/// with the field's ranges. A corner is inside when inside(level, value) > 0; zero counts as outside.
/// Neighbouring blocks share their vertices, so the mesh is closed: every edge has two faces of opposite
/// direction. The exception is AtBox::open, where edges in the sides of the box have one. Features smaller
/// than a cell may be missed.
///
/// Grid: without a box, multiples of `cell` around the bounds; a given box is met exactly, with cells of at
/// most `cell`. Vertices start on grid edges and are moved to the surface (newton_steps = 0: they stay):
/// within 1e-6 cell to first order where the field is smooth, 1e-2 cell at creases and where the surface
/// passes exactly through a corner of the box. Vertices in the sides of the box stay there. A vertex without
/// a gradient has the mean normal of its faces; vertices of a cap have the normal of their side.
///
/// Columns: "value"; "distance_error", -inside / |gradient| (unit of length, positive outside of the solid);
/// "mean_curvature", "gaussian_curvature" (see level_curvature); "member" (index of the nearest primitive of
/// those that matter there). NaN where undefined, and at the cap's own vertices except value and member. The
/// same bytes for any number of threads. Cost and memory grow with the surface, not with the box.
/// Throws InputError ("cell", "box", "newton_steps", "max_memory"), GeometryError when nothing of the surface
/// lies in the box, Cancelled.
[[nodiscard]] FieldMesh polygonize(const ScalarField& field, const MeshOptions& options,
                                   const Progress& progress = {});

/// Edges of a mesh that are not shared by exactly two triangles of opposite direction, and bad faces.
struct MeshDefects {
  std::size_t open_edges = 0, overused_edges = 0, flipped_edges = 0, degenerate_faces = 0,
              repeated_points = 0;
  [[nodiscard]] bool none() const {
    return open_edges + overused_edges + flipped_edges + degenerate_faces + repeated_points == 0;
  }
};
/// A face is degenerate when it names a point twice or its area is below 1e-12 cell^2.
[[nodiscard]] MeshDefects find_defects(const TriMesh& mesh, double cell);

}  // namespace blendwright
