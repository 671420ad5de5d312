#include <BRepCheck.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepCheck_ListOfStatus.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <map>
#include <sstream>

#include "kernel/base/number_text.hpp"
#include "kernel/brep/face_builder.hpp"
#include "kernel/brep/occt_geometry.hpp"
#include "kernel/brep/shape_impl.hpp"

namespace blendwright {
namespace {

const char* kind_of(TopAbs_ShapeEnum type) {
  switch (type) {
    case TopAbs_VERTEX:
      return "vertex";
    case TopAbs_EDGE:
      return "edge";
    case TopAbs_WIRE:
      return "wire";
    case TopAbs_FACE:
      return "face";
    case TopAbs_SHELL:
      return "shell";
    case TopAbs_SOLID:
      return "solid";
    default:
      return "compound";
  }
}

std::string status_name(BRepCheck_Status status) {
  std::ostringstream text;
  BRepCheck::Print(status, text);
  std::string s = text.str();
  while (!s.empty() && (s.back() == '\n' || s.back() == ' ')) s.pop_back();
  return s;
}

/// Everything BRepCheck finds, alone and in the context of the faces.
void add_problems(const TopoDS_Shape& shape, const BRepCheck_Analyzer& analyzer,
                  std::vector<std::string>& problems) {
  TopTools_IndexedMapOfShape all;
  TopExp::MapShapes(shape, all);
  for (int i = 1; i <= all.Extent(); ++i) {
    const auto& result = analyzer.Result(all(i));
    if (result.IsNull()) continue;
    const auto add = [&](const BRepCheck_ListOfStatus& list) {
      for (const BRepCheck_Status s : list)
        if (s != BRepCheck_NoError)
          problems.push_back(std::string(kind_of(all(i).ShapeType())) + " " + std::to_string(i) + ": " +
                             status_name(s));
    };
    add(result->Status());
    for (result->InitContextIterator(); result->MoreShapeInContext(); result->NextShapeInContext())
      add(result->StatusOnShape());
  }
}

/// True when the edge runs along u = lo (0) or u = hi (1) of the face's surface.
std::optional<std::size_t> trimline_side(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  double first = 0, last = 0, u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  const auto pcurve = BRep_Tool::CurveOnSurface(edge, face, first, last);
  if (pcurve.IsNull()) return std::nullopt;
  BRep_Tool::Surface(face)->Bounds(u0, u1, v0, v1);
  const double fuzz = 1e-6 * (u1 - u0);
  bool lo = true, hi = true;
  for (const double t : {0.0, 0.3, 0.7, 1.0}) {
    const double u = pcurve->Value(first + t * (last - first)).X();
    lo = lo && std::abs(u - u0) < fuzz;
    hi = hi && std::abs(u - u1) < fuzz;
  }
  if (lo) return 0;
  if (hi) return 1;
  return std::nullopt;
}

void count_edges(const Shape::Impl& shape, ShapeCheck& check) {
  TopTools_IndexedMapOfShape edges;
  std::map<int, std::size_t> uses;
  for (TopExp_Explorer f(shape.shape, TopAbs_FACE); f.More(); f.Next())
    for (TopExp_Explorer e(f.Current(), TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      if (BRep_Tool::Degenerated(edge)) continue;
      const double gap = detail::edge_gap(edge, TopoDS::Face(f.Current()));
      if (gap < 0.0) check.problems.push_back("an edge has no curve on one of its faces");
      check.largest_edge_gap = std::max(check.largest_edge_gap, gap);
      ++uses[edges.Add(edge)];
    }
  for (const auto& [i, count] : uses)
    if (count == 1) ++check.free_edges;
  for (const ShapeFace& face : shape.faces) {
    if (!face.blend) continue;
    for (TopExp_Explorer e(face.face, TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      if (BRep_Tool::Degenerated(edge) || uses[edges.FindIndex(edge)] != 1) continue;
      const auto side = trimline_side(edge, face.face);
      if (side && face.joined[*side]) ++check.unexpected_free_edges;
    }
  }
}

std::size_t count_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum type) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, type, map);
  return static_cast<std::size_t>(map.Extent());
}

}  // namespace

ShapeCheck check_shape(const Shape& shape) {
  return detail::guarded<GeometryError>("checking the shape", [&] {
    const Shape::Impl& impl = shape.impl();
    ShapeCheck check;
    const BRepCheck_Analyzer analyzer(impl.shape);
    check.valid = analyzer.IsValid();
    if (!check.valid) add_problems(impl.shape, analyzer, check.problems);
    check.largest_tolerance = ShapeAnalysis_ShapeTolerance().Tolerance(impl.shape, 1);
    check.faces = count_of(impl.shape, TopAbs_FACE);
    check.shells = count_of(impl.shape, TopAbs_SHELL);
    check.solids = count_of(impl.shape, TopAbs_SOLID);
    count_edges(impl, check);
    GProp_GProps area;
    BRepGProp::SurfaceProperties(impl.shape, area);
    check.area = std::abs(area.Mass());
    return check;
  });
}

}  // namespace blendwright
