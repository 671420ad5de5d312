#include "kernel/brep/shape.hpp"

#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <algorithm>
#include <limits>

#include "kernel/base/number_text.hpp"
#include "kernel/brep/blend_face.hpp"
#include "kernel/brep/bounded_region.hpp"
#include "kernel/brep/cut_pcurve.hpp"
#include "kernel/brep/occt_geometry.hpp"
#include "kernel/brep/primary_face.hpp"
#include "kernel/brep/primary_geometry.hpp"
#include "kernel/brep/shell_builder.hpp"
#include "kernel/brep/trim_region.hpp"

namespace blendwright {
namespace {

using detail::BlendBorder;
using detail::PrimaryGeometry;
using detail::RegionCut;

/// A primary once it is known how its trimlines divide it.
struct PreparedPrimary {
  const PrimaryPatch* patch = nullptr;
  detail::DividedPrimary divided;
};

std::string cut_name(const Assembly& assembly, const PrimaryCut& cut) {
  return "the trimline of blend " + assembly.blends[cut.blend].name + (cut.side == 0 ? " (from)" : " (to)");
}

/// The trimline in the parameters of the primary's geometry, with derivatives.
CurveJet<2> on_geometry(const PrimaryCut& cut, const PrimaryGeometry& g, double v) {
  CurveJet<2> j = cut.pcurve.jet(v);
  j.D[0] = g(j.D[0]);
  for (std::size_t k = 1; k < 4; ++k) j.D[k] = g.map * j.D[k];
  return j;
}

std::vector<RegionCut> region_cuts(const Assembly& assembly, const PrimaryPatch& patch,
                                   const PrimaryGeometry& g) {
  std::vector<RegionCut> cuts;
  for (const PrimaryCut& cut : patch.cuts)
    cuts.push_back({cut_name(assembly, cut), [&cut, g](double v) { return on_geometry(cut, g, v).C(); },
                    cut.pcurve.domain().v, cut.kept_left != g.flipped()});
  return cuts;
}

PreparedPrimary prepare(const Assembly& assembly, const PrimaryPatch& patch, double tolerance) {
  const PrimaryGeometry plain = detail::primary_geometry(patch.surface, tolerance / 100.0);
  return {&patch,
          detail::divide_primary(
              plain, [&](const PrimaryGeometry& g) { return region_cuts(assembly, patch, g); }, tolerance)};
}

using Borders = std::vector<std::array<BlendBorder, 2>>;

void split_borders(const std::vector<PreparedPrimary>& primaries, Borders& borders) {
  for (const PreparedPrimary& p : primaries)
    for (std::size_t c = 0; c < p.patch->cuts.size(); ++c) {
      const PrimaryCut& cut = p.patch->cuts[c];
      BlendBorder& border = borders[cut.blend][static_cast<std::size_t>(cut.side)];
      if (border.point) continue;
      border.pieces.clear();
      for (const detail::CutPiece& piece : p.divided.region.pieces)
        if (piece.cut == c) border.pieces.push_back(piece.v);
      border.pieces.front().lo = border.v.lo;
      border.pieces.back().hi = border.v.hi;
    }
}

void check_cut(const Assembly& assembly, const PrimaryPatch& patch, const PrimaryCut& cut,
               const Borders& borders) {
  const Interval v = cut.pcurve.domain().v, own = borders[cut.blend][static_cast<std::size_t>(cut.side)].v;
  if (std::abs(v.lo - own.lo) + std::abs(v.hi - own.hi) > 1e-9 * own.length())
    throw GeometryError("primary " + patch.name + ": " + cut_name(assembly, cut) + " runs over v in [" +
                        number_text(v.lo, 6) + ", " + number_text(v.hi, 6) +
                        "], must run over the blend's [" + number_text(own.lo, 6) + ", " +
                        number_text(own.hi, 6) + "]");
}

/// An edge of the primary's own face.
detail::PieceEdge boundary_edge(const PreparedPrimary& p, const detail::CutPiece& piece,
                                detail::VertexPool& pool, double tolerance) {
  const detail::BoundaryLine& line = p.divided.lines[piece.cut - p.patch->cuts.size()];
  const PrimaryGeometry& g = p.divided.geometry;
  const auto curve = opencascade::handle<Geom_Curve>::DownCast(line.curve->Transformed(g.placement));
  const auto pcurve = detail::boundary_pcurve(line, g, piece.shift, piece.v, tolerance);
  if (!(pcurve.gap <= tolerance))
    throw GeometryError("primary " + p.patch->name + ": an edge of its face lies " +
                        scientific_text(pcurve.gap) + " from its curve on the face, must be within " +
                        scientific_text(tolerance) + "; allow more");
  const auto vertex = [&](double t) { return pool.at(detail::vec(curve->Value(t)), 10.0 * tolerance); };
  return {detail::make_edge(curve, piece.v, vertex(piece.v.lo), vertex(piece.v.hi)), pcurve.curve};
}

std::vector<TopoDS_Face> faces_of(const Assembly& assembly, const PreparedPrimary& p, Borders& borders,
                                  double tolerance, std::vector<std::string>& warnings) {
  detail::VertexPool pool(tolerance);
  std::vector<detail::PieceEdge> edges;
  std::vector<std::size_t> used(p.patch->cuts.size(), 0);
  for (const detail::CutPiece& piece : p.divided.region.pieces) {
    if (piece.cut >= p.patch->cuts.size()) {
      edges.push_back(boundary_edge(p, piece, pool, tolerance));
      continue;
    }
    const PrimaryCut& cut = p.patch->cuts[piece.cut];
    const BlendBorder& border = borders[cut.blend][static_cast<std::size_t>(cut.side)];
    if (border.point)
      throw GeometryError("primary " + p.patch->name + ": " + cut_name(assembly, cut) + " has no length");
    const std::size_t i = used[piece.cut]++;
    const auto pcurve = detail::cut_pcurve(
        [&](double v) {
          CurveJet<2> j = on_geometry(cut, p.divided.geometry, v);
          j.D[0] += piece.shift;
          return j;
        },
        border.pieces[i], border.breaks, border.curve, p.divided.geometry.geometry, 0.05 * tolerance);
    if (!(pcurve.gap <= tolerance))
      throw GeometryError("primary " + p.patch->name + ": " + cut_name(assembly, cut) + " lies " +
                          scientific_text(pcurve.gap) + " from the edge of the blend, must be within " +
                          scientific_text(tolerance) + "; fit the blend closer or allow more");
    edges.push_back({border.edges[i], pcurve.curve});
    for (const bool last : {false, true})
      pool.add(last ? TopExp::LastVertex(border.edges[i]) : TopExp::FirstVertex(border.edges[i]));
  }
  for (const std::string& w : p.divided.region.warnings)
    warnings.push_back("primary " + p.patch->name + ": " + w);
  if (p.divided.loses)
    warnings.push_back("primary " + p.patch->name +
                       ": the other boundaries of its face (holes, neighbouring edges) are not carried over; "
                       "what is written reaches to the face's parameter box");
  if (p.divided.region.faces.empty())
    warnings.push_back("primary " + p.patch->name + " is left out of the shape");
  return primary_faces(p.divided.geometry, p.divided.region, edges, pool);
}

AssemblyResult assemble_checked(const Assembly& assembly, double tolerance) {
  std::vector<PreparedPrimary> primaries;
  for (const PrimaryPatch& patch : assembly.primaries)
    primaries.push_back(prepare(assembly, patch, tolerance));
  Borders borders;
  for (const BlendPatch& b : assembly.blends)
    borders.push_back(
        {detail::blend_border(b.surface, 0, tolerance), detail::blend_border(b.surface, 1, tolerance)});
  for (const PreparedPrimary& p : primaries)
    for (const PrimaryCut& cut : p.patch->cuts) check_cut(assembly, *p.patch, cut, borders);
  split_borders(primaries, borders);
  detail::VertexPool corners(tolerance);
  for (auto& pair : borders)
    for (BlendBorder& border : pair) make_edges(border, corners);

  std::vector<std::string> warnings;
  std::vector<ShapeFace> faces;
  for (std::size_t b = 0; b < assembly.blends.size(); ++b) {
    ShapeFace face{blend_face(assembly.blends[b].surface, borders[b], tolerance),
                   assembly.blends[b].name,
                   assembly.blends[b].colour,
                   true,
                   {false, false}};
    for (const PrimaryPatch& patch : assembly.primaries)
      for (const PrimaryCut& cut : patch.cuts)
        if (cut.blend == b) face.joined[static_cast<std::size_t>(cut.side)] = true;
    faces.push_back(std::move(face));
  }
  for (const PreparedPrimary& p : primaries)
    for (TopoDS_Face& face : faces_of(assembly, p, borders, tolerance, warnings)) {
      if (p.divided.geometry.flipped()) face.Reverse();
      faces.push_back({face, p.patch->name, p.patch->colour, false, {true, true}});
    }
  std::vector<TopoDS_Face> plain;
  for (const ShapeFace& f : faces) plain.push_back(f.face);
  detail::measure_tolerances(plain);
  return {Shape(std::make_shared<const Shape::Impl>(detail::build_shells(std::move(faces), warnings))),
          std::move(warnings)};
}

}  // namespace

AssemblyResult assemble(const Assembly& assembly, double tolerance) {
  if (!(tolerance > 0.0)) throw InputError("tolerance", "is " + number_text(tolerance) + ", must be > 0");
  for (const PrimaryPatch& patch : assembly.primaries)
    for (const PrimaryCut& cut : patch.cuts)
      if (cut.blend >= assembly.blends.size() || cut.side < 0 || cut.side > 1)
        throw InputError("primaries/" + patch.name,
                         "a cut names blend " + std::to_string(cut.blend) + ", side " +
                             std::to_string(cut.side) + "; must be one of " +
                             std::to_string(assembly.blends.size()) + ", side 0 or 1");
  return detail::guarded<GeometryError>("joining the faces",
                                        [&] { return assemble_checked(assembly, tolerance); });
}

}  // namespace blendwright
