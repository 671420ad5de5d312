#include "kernel/brep/face_builder.hpp"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Line.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <map>

#include "kernel/brep/occt_geometry.hpp"

namespace blendwright::detail {
namespace {

using opencascade::handle;

const double least = Precision::Confusion();

}  // namespace

TopoDS_Vertex VertexPool::at(const Vec3& p, double tolerance) {
  const TopoDS_Vertex* best = nullptr;
  double nearest = tolerance;
  for (const TopoDS_Vertex& v : vertices_)
    if (const double d = (vec(BRep_Tool::Pnt(v)) - p).norm(); d <= nearest) {
      nearest = d;
      best = &v;
    }
  if (best) return *best;
  TopoDS_Vertex made;
  BRep_Builder().MakeVertex(made, pnt(p), least);
  vertices_.push_back(made);
  return made;
}

TopoDS_Edge make_edge(const handle<Geom_Curve>& curve, const Interval& range, const TopoDS_Vertex& first,
                      const TopoDS_Vertex& last) {
  const BRep_Builder builder;
  TopoDS_Edge edge;
  builder.MakeEdge(edge, curve, least);
  builder.Range(edge, range.lo, range.hi);
  builder.Add(edge, first.Oriented(TopAbs_FORWARD));
  builder.Add(edge, last.Oriented(TopAbs_REVERSED));
  edge.Closed(first.IsSame(last));
  builder.SameRange(edge, true);
  builder.SameParameter(edge, true);
  return edge;
}

TopoDS_Edge make_degenerated_edge(const Interval& range, const TopoDS_Vertex& vertex) {
  const BRep_Builder builder;
  TopoDS_Edge edge;
  builder.MakeEdge(edge);
  builder.Add(edge, vertex.Oriented(TopAbs_FORWARD));
  builder.Add(edge, vertex.Oriented(TopAbs_REVERSED));
  builder.Range(edge, range.lo, range.hi);
  builder.Degenerated(edge, true);
  builder.SameRange(edge, true);
  builder.SameParameter(edge, true);
  return edge;
}

handle<Geom2d_Curve> parameter_line(const Vec2& start, const Vec2& direction) {
  return new Geom2d_Line(gp_Pnt2d(start.x(), start.y()), gp_Dir2d(direction.x(), direction.y()));
}

TopoDS_Face make_face(const handle<Geom_Surface>& surface) {
  TopoDS_Face face;
  BRep_Builder().MakeFace(face, surface, least);
  return face;
}

void add_pcurve(const TopoDS_Edge& edge, const handle<Geom2d_Curve>& pcurve, const TopoDS_Face& face,
                const Interval& range) {
  BRep_Builder().UpdateEdge(edge, pcurve, face, least);
  BRep_Builder().Range(edge, face, range.lo, range.hi);
}

void add_seam_pcurves(const TopoDS_Edge& edge, const handle<Geom2d_Curve>& forward,
                      const handle<Geom2d_Curve>& backward, const TopoDS_Face& face, const Interval& range) {
  BRep_Builder().UpdateEdge(edge, forward, backward, face, least);
  BRep_Builder().Range(edge, face, range.lo, range.hi);
  BRep_Builder().Continuity(edge, face, face, GeomAbs_CN);
}

void add_wire(TopoDS_Face& face, const std::vector<EdgeUse>& edges) {
  const BRep_Builder builder;
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (const EdgeUse& use : edges)
    builder.Add(wire, use.edge.Oriented(use.forward ? TopAbs_FORWARD : TopAbs_REVERSED));
  wire.Closed(true);
  builder.Add(face, wire);
}

double edge_gap(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  if (BRep_Tool::Degenerated(edge)) return 0.0;
  double a = 0, b = 0, first = 0, last = 0;
  const handle<Geom_Curve> curve = BRep_Tool::Curve(edge, a, b);
  const handle<Geom2d_Curve> pcurve = BRep_Tool::CurveOnSurface(edge, face, first, last);
  if (curve.IsNull() || pcurve.IsNull()) return -1.0;
  const handle<Geom_Surface> surface = BRep_Tool::Surface(face);
  // Several samples per polynomial piece of the curve, so that a piece that is off is seen.
  const int samples = std::clamp(4 * GeomAdaptor_Curve(curve, a, b).NbIntervals(GeomAbs_CN), 64, 4096);
  double worst = 0.0;
  for (int i = 0; i <= samples; ++i) {
    const double t = static_cast<double>(i) / samples;
    const gp_Pnt2d uv = pcurve->Value(first + t * (last - first));
    worst = std::max(worst, curve->Value(a + t * (b - a)).Distance(surface->Value(uv.X(), uv.Y())));
  }
  return worst;
}

void measure_tolerances(const std::vector<TopoDS_Face>& faces) {
  constexpr double margin = 1.05;  // samples may miss the worst place by a little
  const BRep_Builder builder;
  TopTools_IndexedMapOfShape vertices, edges;
  std::map<int, double> off, gap;
  for (const TopoDS_Face& face : faces)
    for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      double& worst = gap[edges.Add(edge)];
      worst = std::max(worst, edge_gap(edge, face));
      double first = 0, last = 0;
      const handle<Geom2d_Curve> pcurve = BRep_Tool::CurveOnSurface(edge, face, first, last);
      const handle<Geom_Surface> surface = BRep_Tool::Surface(face);
      for (TopExp_Explorer x(edge.Oriented(TopAbs_FORWARD), TopAbs_VERTEX); x.More(); x.Next()) {
        const TopoDS_Vertex vertex = TopoDS::Vertex(x.Current());
        const bool start = vertex.Orientation() == TopAbs_FORWARD;
        const gp_Pnt2d uv = pcurve->Value(start ? first : last);
        double& distance = off[vertices.Add(vertex.Oriented(TopAbs_FORWARD))];
        distance =
            std::max({distance, BRep_Tool::Pnt(vertex).Distance(surface->Value(uv.X(), uv.Y())), worst});
        if (BRep_Tool::Degenerated(edge)) continue;
        double a = 0, b = 0;
        const handle<Geom_Curve> curve = BRep_Tool::Curve(edge, a, b);
        distance = std::max(distance, BRep_Tool::Pnt(vertex).Distance(curve->Value(start ? a : b)));
      }
    }
  for (const auto& [i, value] : gap)
    builder.UpdateEdge(TopoDS::Edge(edges(i)), std::max(least, margin * value));
  for (const auto& [i, value] : off)
    builder.UpdateVertex(TopoDS::Vertex(vertices(i)), std::max(least, margin * value));
}

}  // namespace blendwright::detail
