#pragma once
// Private: the faces of a primary from the wires of its kept region.
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <vector>

#include "kernel/brep/face_builder.hpp"
#include "kernel/brep/primary_geometry.hpp"
#include "kernel/brep/trim_region.hpp"

namespace blendwright::detail {

/// The shared edge of each piece of `region`, and its parameter curve on the primary.
struct PieceEdge {
  TopoDS_Edge edge;
  opencascade::handle<Geom2d_Curve> pcurve;
};

/// Faces with the normal of the geometry. `pool` holds the vertices of the shared edges.
[[nodiscard]] std::vector<TopoDS_Face> primary_faces(const PrimaryGeometry& primary, const TrimRegion& region,
                                                     const std::vector<PieceEdge>& edges, VertexPool& pool);

}  // namespace blendwright::detail
