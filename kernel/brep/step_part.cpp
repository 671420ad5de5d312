#include "kernel/brep/step_part.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepGProp.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <GProp_GProps.hxx>
#include <STEPControl_Reader.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <gp_Circ.hxx>
#include <gp_Elips.hxx>

#include "kernel/base/number_text.hpp"
#include "kernel/brep/face_boundary.hpp"
#include "kernel/brep/occt_geometry.hpp"
#include "kernel/brep/occt_session.hpp"
#include "kernel/brep/occt_surface.hpp"
#include "kernel/brep/step_guard.hpp"
#include "kernel/brep/step_part_impl.hpp"

namespace blendwright {
namespace {

using opencascade::handle;

std::string step_name(const STEPControl_Reader& reader, const TopoDS_Shape& shape) {
  const auto transfer = reader.WS()->TransferReader();
  for (const int mode : {1, 3}) {
    const auto item =
        handle<StepRepr_RepresentationItem>::DownCast(transfer->EntityFromShapeResult(shape, mode));
    if (!item.IsNull() && !item->Name().IsNull()) return item->Name()->ToCString();
  }
  return "";
}

/// Points well inside the face, best first: middles of the stretches of a few parameter lines that lie in it.
std::vector<Vec3> anchors_of(const TopoDS_Face& face, const detail::FaceGeometry& g) {
  const BRepTopAdaptor_FClass2d classifier(face, 1e-9 * (g.box.u.length() + g.box.v.length()));
  constexpr int steps = 48;
  struct Stretch {
    int length = 0;
    Vec2 middle;
  };
  std::vector<Stretch> found;
  for (const double t : {0.5, 0.3, 0.7, 0.1, 0.9, 0.03, 0.97}) {
    int run = 0;
    for (int i = 0; i <= steps; ++i) {
      const Vec2 uv(g.box.u.at((i + 0.5) / steps), g.box.v.at(t));
      const bool in = i < steps && classifier.Perform(detail::pnt(uv)) == TopAbs_IN;
      if (in) ++run;
      if (in || run == 0) continue;
      for (const double part : {0.5, 0.2, 0.8})  // the middle first
        found.push_back({part == 0.5 ? run : run / 4, {g.box.u.at((i - part * run) / steps), g.box.v.at(t)}});
      run = 0;
    }
  }
  if (found.empty()) found.push_back({0, {g.box.u.middle(), g.box.v.middle()}});
  // A stretch of a quarter of the line is as good as a longer one: the middle line comes first then.
  std::stable_sort(found.begin(), found.end(), [](const Stretch& a, const Stretch& b) {
    return std::min(a.length, steps / 4) > std::min(b.length, steps / 4);
  });
  std::vector<Vec3> points;
  for (const Stretch& s : found) points.push_back(detail::vec(g.geometry->Value(s.middle.x(), s.middle.y())));
  return points;
}

/// Chooses anchors that lie on no other face of the same kind where there are such: solids of an assembly
/// touch.
void choose_anchors(StepPart::Impl& part) {
  std::vector<Bnd_Box> boxes(part.faces.size());
  for (const FaceInfo& f : part.faces) BRepBndLib::Add(part.face(f.index), boxes[f.index]);
  const double slack = 1e-5 * part.size;
  const auto alone = [&](const FaceInfo& face, const Vec3& p) {
    for (const FaceInfo& other : part.faces) {
      if (other.index == face.index || other.surface != face.surface) continue;
      Bnd_Box box = boxes[other.index];
      box.Enlarge(slack);
      if (box.IsOut(detail::pnt(p))) continue;
      BRepExtrema_DistShapeShape d(BRepBuilderAPI_MakeVertex(detail::pnt(p)).Vertex(),
                                   part.face(other.index));
      if (d.IsDone() && d.NbSolution() > 0 && d.Value() <= slack) return false;
    }
    return true;
  };
  for (FaceInfo& f : part.faces) {
    const std::vector<Vec3> points =
        anchors_of(part.face(f.index), detail::face_geometry(part.face(f.index)));
    const auto best = std::find_if(points.begin(), points.end(), [&](const Vec3& p) { return alone(f, p); });
    f.anchor = best == points.end() ? points.front() : *best;
  }
}

FaceInfo describe(const TopoDS_Face& face, std::size_t index) {
  const detail::FaceGeometry g = detail::face_geometry(face);
  GProp_GProps area;
  BRepGProp::SurfaceProperties(face, area);
  FaceInfo info;
  info.index = index;
  info.surface = detail::surface_kind(g.geometry);
  info.size = detail::size_text(g);
  info.area = std::abs(area.Mass());
  info.reversed = g.reversed;
  return info;
}

EdgeInfo describe(const TopoDS_Edge& edge, std::size_t index) {
  const BRepAdaptor_Curve c(edge);
  EdgeInfo info;
  info.index = index;
  info.length = GCPnts_AbscissaPoint::Length(c);
  info.anchor = detail::vec(c.Value(0.5 * (c.FirstParameter() + c.LastParameter())));
  switch (c.GetType()) {
    case GeomAbs_Line:
      info.curve = "line";
      break;
    case GeomAbs_Circle:
      info.curve = "circle";
      info.size = "radius " + number_text(c.Circle().Radius(), 6) + ", ";
      break;
    case GeomAbs_Ellipse:
      info.curve = "ellipse";
      info.size = "radii " + number_text(c.Ellipse().MajorRadius(), 6) + " and " +
                  number_text(c.Ellipse().MinorRadius(), 6) + ", ";
      break;
    case GeomAbs_BezierCurve:
    case GeomAbs_BSplineCurve:
      info.curve = "bspline";
      break;
    default:
      info.curve = "other";
  }
  info.size += "length " + number_text(info.length, 6);
  const TopoDS_Vertex first = TopExp::FirstVertex(edge), last = TopExp::LastVertex(edge);
  info.closed = !first.IsNull() && first.IsSame(last);
  return info;
}

void fill(StepPart::Impl& part) {
  TopExp::MapShapes(part.shape, TopAbs_FACE, part.face_map);
  for (TopExp_Explorer e(part.shape, TopAbs_EDGE); e.More(); e.Next())
    if (!BRep_Tool::Degenerated(TopoDS::Edge(e.Current()))) part.edge_map.Add(e.Current());
  TopExp::MapShapesAndAncestors(part.shape, TopAbs_VERTEX, TopAbs_EDGE, part.edges_at_vertex);
  for (std::size_t i = 0; i < static_cast<std::size_t>(part.edge_map.Extent()); ++i)
    part.edges.push_back(describe(part.edge(i), i));
  for (std::size_t i = 0; i < static_cast<std::size_t>(part.face_map.Extent()); ++i) {
    part.faces.push_back(describe(part.face(i), i));
    for (TopExp_Explorer e(part.face(i), TopAbs_EDGE); e.More(); e.Next()) {
      const int k = part.edge_map.FindIndex(e.Current());
      if (k == 0) continue;
      auto& faces = part.edges[static_cast<std::size_t>(k - 1)].faces;
      if (faces.empty() || faces.back() != i) faces.push_back(i);
    }
  }
  Bnd_Box box;
  BRepBndLib::Add(part.shape, box);
  part.size = std::sqrt(box.SquareExtent());
  choose_anchors(part);
  part.tolerance = ShapeAnalysis_ShapeTolerance().Tolerance(part.shape, 1);
  part.valid = BRepCheck_Analyzer(part.shape).IsValid();
  for (TopExp_Explorer e(part.shape, TopAbs_SOLID); e.More(); e.Next()) ++part.solids;
}

}  // namespace

StepPart StepPart::read(const std::filesystem::path& file, LengthUnit unit) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw IoError(file.string() + ": is not a file that can be read; give the path of a STEP file");
  const detail::ExchangeSession session(unit);
  StepPart result;
  detail::read_guarded(file, [&] {
    STEPControl_Reader reader;
    if (reader.ReadFile(file.c_str()) != IFSelect_RetDone)
      throw IoError(file.string() + ": is not a STEP file (ISO 10303-21) that can be read");
    detail::require_whole_entities(reader.WS()->Model(), file);
    reader.TransferRoots();
    auto part = std::make_shared<Impl>();
    part->shape = reader.OneShape();
    if (part->shape.IsNull()) throw IoError(file.string() + ": contains no shape");
    fill(*part);
    if (part->faces.empty()) throw IoError(file.string() + ": contains no face");
    for (FaceInfo& f : part->faces) f.name = step_name(reader, part->face(f.index));
    for (TopExp_Explorer s(part->shape, TopAbs_SOLID); s.More(); s.Next()) {
      const std::string solid = step_name(reader, s.Current());
      for (TopExp_Explorer f(s.Current(), TopAbs_FACE); f.More(); f.Next())
        part->faces[static_cast<std::size_t>(part->face_map.FindIndex(f.Current()) - 1)].solid = solid;
    }
    result.impl_ = part;
  });
  return result;
}

const std::vector<FaceInfo>& StepPart::faces() const { return impl_->faces; }
const std::vector<EdgeInfo>& StepPart::edges() const { return impl_->edges; }
double StepPart::tolerance() const { return impl_->tolerance; }
std::size_t StepPart::solids() const { return impl_->solids; }
bool StepPart::valid() const { return impl_->valid; }

Surface StepPart::surface(std::size_t face) const {
  if (face >= impl_->faces.size())
    throw InputError("face",
                     "is " + std::to_string(face) + ", must be below " + std::to_string(impl_->faces.size()));
  return detail::guarded<GeometryError>("face " + std::to_string(face), [&] {
    detail::FaceGeometry g = detail::face_geometry(impl_->face(face));
    g.boundary = std::make_shared<const detail::FaceBoundary>(detail::face_boundary(*impl_, {face}, g));
    return detail::oriented_surface(g);
  });
}

}  // namespace blendwright
