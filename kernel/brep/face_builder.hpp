#pragma once
// Private: faces whose edges are shared, built from curves and parameter curves that agree by construction.
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <vector>

#include "kernel/base/units.hpp"

namespace blendwright::detail {

/// Vertices by place: a point nearer than the tolerance to a vertex of the pool is that vertex.
class VertexPool {
 public:
  explicit VertexPool(double tolerance) : tolerance_(tolerance) {}
  [[nodiscard]] TopoDS_Vertex at(const Vec3& p) { return at(p, tolerance_); }
  [[nodiscard]] TopoDS_Vertex at(const Vec3& p, double tolerance);
  void add(const TopoDS_Vertex& vertex) { vertices_.push_back(vertex); }

 private:
  double tolerance_;
  std::vector<TopoDS_Vertex> vertices_;
};

[[nodiscard]] TopoDS_Edge make_edge(const opencascade::handle<Geom_Curve>& curve, const Interval& range,
                                    const TopoDS_Vertex& first, const TopoDS_Vertex& last);
/// An edge without length: a pole.
[[nodiscard]] TopoDS_Edge make_degenerated_edge(const Interval& range, const TopoDS_Vertex& vertex);

/// The straight parameter curve start + t * direction (a unit parameter direction).
[[nodiscard]] opencascade::handle<Geom2d_Curve> parameter_line(const Vec2& start, const Vec2& direction);

struct EdgeUse {
  TopoDS_Edge edge;
  bool forward = true;
};

[[nodiscard]] TopoDS_Face make_face(const opencascade::handle<Geom_Surface>& surface);
void add_pcurve(const TopoDS_Edge& edge, const opencascade::handle<Geom2d_Curve>& pcurve,
                const TopoDS_Face& face, const Interval& range);
/// Of a seam: one parameter curve where the edge runs forward on the face, one where it runs backward.
void add_seam_pcurves(const TopoDS_Edge& edge, const opencascade::handle<Geom2d_Curve>& forward,
                      const opencascade::handle<Geom2d_Curve>& backward, const TopoDS_Face& face,
                      const Interval& range);
void add_wire(TopoDS_Face& face, const std::vector<EdgeUse>& edges);

/// Largest distance between the edge's curve and its parameter curve on the face, at equal parameters; -1
/// when the edge has no parameter curve there, 0 for a degenerated edge.
[[nodiscard]] double edge_gap(const TopoDS_Edge& edge, const TopoDS_Face& face);
/// Sets the tolerances of all edges and vertices to what is measured, never below the CAD kernel's smallest
/// (1e-7).
void measure_tolerances(const std::vector<TopoDS_Face>& faces);

}  // namespace blendwright::detail
