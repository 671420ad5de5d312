#include "kernel/brep/primary_face.hpp"

#include <Geom_TrimmedCurve.hxx>
#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/brep/occt_geometry.hpp"

namespace blendwright::detail {
namespace {

using opencascade::handle;
using Kind = RegionSegment::Kind;

/// A stretch of a straight parameter line: its free parameter (0: u, 1: v), the value of the other one, its
/// range.
struct Stretch {
  int along = 0;
  double value = 0.0;
  Interval range;
  bool increasing = true;
};

Stretch stretch(const RegionSegment& s) {
  const Vec2 d = s.to - s.from;
  Stretch r;
  r.along = s.kind == Kind::border ? (s.side % 2 == 0 ? 0 : 1) : (std::abs(d.x()) > std::abs(d.y()) ? 0 : 1);
  r.value = s.from[1 - r.along];
  r.increasing = d[r.along] > 0.0;
  r.range = {std::min(s.from[r.along], s.to[r.along]), std::max(s.from[r.along], s.to[r.along])};
  return r;
}

/// An edge along a parameter line, used once or, on a seam, once from either side.
struct LineEdge {
  Stretch first;
  TopoDS_Edge edge;
  std::vector<Stretch> uses;
};

class Builder {
 public:
  Builder(const PrimaryGeometry& primary, const TrimRegion& region, const std::vector<PieceEdge>& edges,
          VertexPool& pool)
      : primary_(primary), region_(region), edges_(edges), pool_(pool) {}

  [[nodiscard]] std::vector<TopoDS_Face> faces() {
    for (const RegionFace& f : region_.faces) {
      for_wires(f, [&](const RegionWire& w) {
        for (const RegionSegment& s : w)
          if (s.kind != Kind::cut) line_edge(stretch(s)).uses.push_back(stretch(s));
      });
    }
    std::vector<TopoDS_Face> made;
    for (const RegionFace& f : region_.faces) {
      // Parameter curves are kept by surface: two faces must not share one, their sides of a seam differ.
      TopoDS_Face face =
          make_face(region_.faces.size() == 1 ? primary_.geometry
                                              : handle<Geom_Surface>::DownCast(primary_.geometry->Copy()));
      for_wires(f, [&](const RegionWire& w) { add(face, w); });
      made.push_back(face);
    }
    return made;
  }

 private:
  template <class Body>
  static void for_wires(const RegionFace& f, Body body) {
    body(f.outer);
    for (const RegionWire& h : f.holes) body(h);
  }

  [[nodiscard]] Vec3 point(int along, double t, double value) const {
    const Vec2 uv = along == 0 ? Vec2(t, value) : Vec2(value, t);
    return vec(primary_.geometry->Value(uv.x(), uv.y()));
  }

  [[nodiscard]] bool same_place(const Stretch& a, const Stretch& b) const {
    if (a.along != b.along) return false;
    const Interval across = a.along == 0 ? primary_.box.v : primary_.box.u;
    const Interval along = a.along == 0 ? primary_.box.u : primary_.box.v;
    const bool closed = a.along == 0 ? primary_.box.v_closed : primary_.box.u_closed;
    const double apart = std::abs(a.value - b.value), fuzz = 1e-7 * along.length();
    const bool value = apart <= 1e-9 * across.length() ||
                       (closed && std::abs(apart - across.length()) <= 1e-9 * across.length());
    return value && std::abs(a.range.lo - b.range.lo) <= fuzz && std::abs(a.range.hi - b.range.hi) <= fuzz;
  }

  LineEdge& line_edge(const Stretch& s) {
    for (LineEdge& e : lines_)
      if (same_place(e.first, s)) return e;
    const Vec3 a = point(s.along, s.range.lo, s.value), b = point(s.along, s.range.hi, s.value);
    double size = 0.0;
    for (const double t : {0.0, 0.17, 0.38, 0.55, 0.81, 1.0})
      size = std::max(size, (point(s.along, s.range.at(t), s.value) - a).norm());
    const Vec3 middle = vec(primary_.geometry->Value(primary_.box.u.middle(), primary_.box.v.middle()));
    if (size <= 1e-9 * ((middle - a).norm() + 1e-300)) {
      lines_.push_back({s, make_degenerated_edge(s.range, pool_.at(a)), {}});
      return lines_.back();
    }
    handle<Geom_Curve> curve =
        s.along == 0 ? primary_.geometry->VIso(s.value) : primary_.geometry->UIso(s.value);
    while (const auto trimmed = handle<Geom_TrimmedCurve>::DownCast(curve)) curve = trimmed->BasisCurve();
    lines_.push_back({s, make_edge(curve, s.range, pool_.at(a), pool_.at(b)), {}});
    return lines_.back();
  }

  [[nodiscard]] handle<Geom2d_Curve> line(const Stretch& s) const {
    return s.along == 0 ? parameter_line({0.0, s.value}, {1.0, 0.0})
                        : parameter_line({s.value, 0.0}, {0.0, 1.0});
  }

  void add(TopoDS_Face& face, const RegionWire& wire) {
    std::vector<EdgeUse> uses;
    for (const RegionSegment& s : wire) {
      if (s.kind == Kind::cut) {
        const PieceEdge& e = edges_[s.piece];
        add_pcurve(e.edge, e.pcurve, face, region_.pieces[s.piece].v);
        uses.push_back({e.edge, !s.backward});
        continue;
      }
      const Stretch here = stretch(s);
      const LineEdge& e = line_edge(here);
      const auto other = std::find_if(e.uses.begin(), e.uses.end(),
                                      [&](const Stretch& u) { return u.increasing != here.increasing; });
      // Both sides of a seam on one face; two faces that meet at a seam have one parameter curve each.
      if (other == e.uses.end() || region_.faces.size() > 1)
        add_pcurve(e.edge, line(here), face, e.first.range);
      else if (here.increasing)
        add_seam_pcurves(e.edge, line(here), line(*other), face, e.first.range);
      uses.push_back({e.edge, here.increasing});
    }
    add_wire(face, uses);
  }

  const PrimaryGeometry& primary_;
  const TrimRegion& region_;
  const std::vector<PieceEdge>& edges_;
  VertexPool& pool_;
  std::vector<LineEdge> lines_;
};

}  // namespace

std::vector<TopoDS_Face> primary_faces(const PrimaryGeometry& primary, const TrimRegion& region,
                                       const std::vector<PieceEdge>& edges, VertexPool& pool) {
  return Builder(primary, region, edges, pool).faces();
}

}  // namespace blendwright::detail
