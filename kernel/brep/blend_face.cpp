#include "kernel/brep/blend_face.hpp"

#include <TopExp.hxx>
#include <TopoDS.hxx>

#include "kernel/brep/occt_geometry.hpp"

namespace blendwright::detail {
namespace {

using opencascade::handle;

/// Largest distance between two curves at equal parameters.
template <class A, class B>
double apart(A a, B b, const Interval& t) {
  double worst = 0.0;
  for (int i = 0; i <= 64; ++i) worst = std::max(worst, (a(t.at(i / 64.0)) - b(t.at(i / 64.0))).norm());
  return worst;
}

TopoDS_Vertex border_vertex(const BlendBorder& border, bool end) {
  const TopoDS_Edge& edge = end ? border.edges.back() : border.edges.front();
  TopoDS_Vertex first, last;
  TopExp::Vertices(edge, first, last);
  return end ? last : first;
}

class Builder {
 public:
  Builder(const BSplineSurface& blend, const std::array<BlendBorder, 2>& borders, double tolerance)
      : borders_(borders),
        u_(blend.domain().u),
        v_(blend.domain().v),
        surface_(to_occt(blend)),
        face_(make_face(surface_)),
        tolerance_(tolerance),
        periodic_(blend.domain().v_closed) {}

  [[nodiscard]] TopoDS_Face face() {
    const auto at = [&](double v) { return [this, v](double u) { return vec(surface_->Value(u, v)); }; };
    const bool meet = periodic_ || (borders_[0].returns && borders_[1].returns &&
                                    apart(at(v_.lo), at(v_.hi), u_) <= tolerance_);
    std::vector<EdgeUse> wire;
    const TopoDS_Edge start = side(v_.lo, false);
    const TopoDS_Edge end = meet ? start : side(v_.hi, true);
    if (meet)
      add_seam_pcurves(start, row(v_.lo), row(v_.hi), face_, u_);
    else {
      add_pcurve(start, row(v_.lo), face_, u_);
      add_pcurve(end, row(v_.hi), face_, u_);
    }
    wire.push_back({start, true});
    add_border(wire, 1);
    wire.push_back({end, false});
    add_border(wire, 0);
    add_wire(face_, wire);
    return face_;
  }

 private:
  [[nodiscard]] handle<Geom2d_Curve> row(double v) const { return parameter_line({0.0, v}, {1.0, 0.0}); }

  [[nodiscard]] TopoDS_Edge side(double v, bool end) const {
    const TopoDS_Vertex a = border_vertex(borders_[0], end), b = border_vertex(borders_[1], end);
    const auto at = [&](double u) { return vec(surface_->Value(u, v)); };
    if (a.IsSame(b) && apart(
                           at, [&](double) { return at(u_.lo); }, u_) <= tolerance_)
      return make_degenerated_edge(u_, a);
    return make_edge(surface_->VIso(v), u_, a, b);
  }

  /// u = hi runs with v, u = lo against it: counter-clockwise.
  void add_border(std::vector<EdgeUse>& wire, std::size_t side) {
    const BlendBorder& b = borders_[side];
    std::vector<EdgeUse> uses;
    for (std::size_t i = 0; i < b.edges.size(); ++i) {
      add_pcurve(b.edges[i], parameter_line({side == 0 ? u_.lo : u_.hi, 0.0}, {0.0, 1.0}), face_,
                 b.pieces[i]);
      uses.push_back({b.edges[i], side == 1});
    }
    if (side == 1)
      wire.insert(wire.end(), uses.begin(), uses.end());
    else
      wire.insert(wire.end(), uses.rbegin(), uses.rend());
  }

  const std::array<BlendBorder, 2>& borders_;
  Interval u_, v_;
  handle<Geom_BSplineSurface> surface_;
  TopoDS_Face face_;
  double tolerance_;
  bool periodic_;
};

}  // namespace

BlendBorder blend_border(const BSplineSurface& blend, int side, double tolerance) {
  const BSplineCurve<3> curve = blend.edge_u(side);
  BlendBorder b;
  b.curve = to_occt(curve);
  b.breaks = curve.basis().breaks();
  b.v = curve.domain().v;
  const auto at = [&](double v) { return curve.jet(v).C(); };
  b.returns = curve.domain().closed || (at(b.v.lo) - at(b.v.hi)).norm() <= tolerance;
  b.point = apart(
                at, [&](double) { return at(b.v.lo); }, b.v) <= tolerance;
  b.pieces = {b.v};
  return b;
}

void make_edges(BlendBorder& border, VertexPool& corners) {
  const auto corner = [&](double v) { return corners.at(vec(border.curve->Value(v))); };
  TopoDS_Vertex first = corner(border.v.lo);
  const TopoDS_Vertex start = first;
  border.edges.clear();
  if (border.point) {
    border.edges.push_back(make_degenerated_edge(border.v, start));
    return;
  }
  for (std::size_t i = 0; i < border.pieces.size(); ++i) {
    const bool last = i + 1 == border.pieces.size();
    const TopoDS_Vertex end = last && border.returns ? start : corner(border.pieces[i].hi);
    border.edges.push_back(make_edge(border.curve, border.pieces[i], first, end));
    first = end;
  }
}

TopoDS_Face blend_face(const BSplineSurface& blend, const std::array<BlendBorder, 2>& borders,
                       double tolerance) {
  return Builder(blend, borders, tolerance).face();
}

}  // namespace blendwright::detail
