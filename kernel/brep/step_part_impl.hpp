#pragma once
// Private: what a StepPart holds.
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_Vertex.hxx>

#include "kernel/brep/step_part.hpp"

namespace blendwright {

struct StepPart::Impl {
  TopoDS_Shape shape;
  TopTools_IndexedMapOfShape face_map,
      edge_map;  ///< index + 1 of faces, edges; edges without the degenerated ones
  TopTools_IndexedDataMapOfShapeListOfShape edges_at_vertex;
  std::vector<FaceInfo> faces;
  std::vector<EdgeInfo> edges;
  double tolerance = 0.0, size = 0.0;  ///< size: diagonal of the bounding box
  std::size_t solids = 0;
  bool valid = false;

  [[nodiscard]] const TopoDS_Face& face(std::size_t i) const {
    return TopoDS::Face(face_map.FindKey(static_cast<int>(i) + 1));
  }
  [[nodiscard]] const TopoDS_Edge& edge(std::size_t i) const {
    return TopoDS::Edge(edge_map.FindKey(static_cast<int>(i) + 1));
  }
};

}  // namespace blendwright
