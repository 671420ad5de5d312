#include "kernel/brep/face_boundary.hpp"

#include <BRep_Tool.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp_Explorer.hxx>
#include <algorithm>
#include <cmath>

#include "kernel/brep/edge_chain.hpp"
#include "kernel/brep/occt_geometry.hpp"

namespace blendwright::detail {
namespace {

using opencascade::handle;

/// Parameters of a surface along a curve that lies on it.
class ParameterImage {
 public:
  /// The image's middle is taken next to `near`.
  ParameterImage(handle<Geom_Surface> surface, handle<Geom_Curve> curve, handle<Geom2d_Curve> guess,
                 const Interval& t, const Vec2& near)
      : surface_(std::move(surface)), curve_(std::move(curve)), guess_(std::move(guess)), t_(t) {
    for (std::size_t i = 0; i <= steps; ++i) {
      const Vec2 uv = at(t_.at(static_cast<double>(i) / steps));
      table_.push_back(i == 0 ? uv : wrapped(uv, table_.back()));
    }
    const Vec2 middle = table_[steps / 2], shift = wrapped(middle, near) - middle;
    for (Vec2& uv : table_) uv += shift;
  }

  [[nodiscard]] CurveJet<2> operator()(double t) const {
    const auto i = static_cast<std::size_t>(
        std::clamp(std::round((t - t_.lo) / t_.length() * steps), 0.0, static_cast<double>(steps)));
    CurveJet<2> j;
    for (Vec2& d : j.D) d.setZero();
    j.D[0] = wrapped(at(t), table_[i]);
    gp_Pnt p;
    gp_Vec c1, c2, u, v, uu, vv, uv;
    curve_->D2(t, p, c1, c2);
    surface_->D2(j.D[0].x(), j.D[0].y(), p, u, v, uu, vv, uv);
    j.D[1] = tangential(vec(u), vec(v), vec(c1));
    const double x = j.D[1].x(), y = j.D[1].y();
    j.D[2] = tangential(vec(u), vec(v), vec(c2) - x * x * vec(uu) - 2.0 * x * y * vec(uv) - y * y * vec(vv));
    return j;
  }

 private:
  /// a, b with a Su + b Sv nearest to d.
  static Vec2 tangential(const Vec3& Su, const Vec3& Sv, const Vec3& d) {
    const double E = Su.dot(Su), F = Su.dot(Sv), G = Sv.dot(Sv), det = E * G - F * F;
    if (!(det > 1e-14 * E * G)) return Vec2::Zero();
    return {(G * Su.dot(d) - F * Sv.dot(d)) / det, (E * Sv.dot(d) - F * Su.dot(d)) / det};
  }
  [[nodiscard]] Vec2 at(double t) const {
    const Vec3 p = vec(curve_->Value(t));
    if (const auto uv = elementary_parameters(surface_, p)) return *uv;
    const gp_Pnt2d guess = guess_->Value(t);
    return foot_near(surface_, p, {guess.X(), guess.Y()});
  }
  [[nodiscard]] Vec2 wrapped(Vec2 uv, const Vec2& near) const {
    if (surface_->IsUPeriodic())
      uv.x() += surface_->UPeriod() * std::round((near.x() - uv.x()) / surface_->UPeriod());
    if (surface_->IsVPeriodic())
      uv.y() += surface_->VPeriod() * std::round((near.y() - uv.y()) / surface_->VPeriod());
    return uv;
  }

  static constexpr int steps = 128;
  handle<Geom_Surface> surface_;
  handle<Geom_Curve> curve_;
  handle<Geom2d_Curve> guess_;
  Interval t_;
  std::vector<Vec2> table_;
};

std::vector<double> smooth_intervals(const handle<Geom_Curve>& curve, const Interval& t) {
  const GeomAdaptor_Curve adaptor(curve, t.lo, t.hi);
  TColStd_Array1OfReal at(1, adaptor.NbIntervals(GeomAbs_C3) + 1);
  adaptor.Intervals(at, GeomAbs_C3);
  return {at.begin(), at.end()};
}

bool material_left(const TopoDS_Face& face, const TopoDS_Edge& edge) {
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next())
    if (e.Current().IsSame(edge)) return e.Current().Orientation() == TopAbs_FORWARD;
  return true;
}

}  // namespace

FaceBoundary face_boundary(const StepPart::Impl& part, const std::set<std::size_t>& group,
                           const FaceGeometry& carrier) {
  FaceBoundary boundary;
  for (const auto& [edge, face] : border_edges(part, group)) {
    double a = 0, b = 0, first = 0, last = 0;
    BoundaryLine line;
    line.curve = BRep_Tool::Curve(part.edge(edge), a, b);
    const auto guess = BRep_Tool::CurveOnSurface(part.edge(edge), part.face(face), first, last);
    if (line.curve.IsNull() || (guess.IsNull() && !elementary_parameters(carrier.geometry, Vec3::Zero())))
      continue;
    line.t = {a, b};
    line.breaks = smooth_intervals(line.curve, line.t);
    const ParameterImage image(carrier.geometry, line.curve, guess, line.t,
                               {carrier.box.u.middle(), carrier.box.v.middle()});
    line.jet = image;
    line.kept_left = material_left(part.face(face), part.edge(edge)) != carrier.reversed;
    for (int i = 0; i <= 64; ++i) {
      const double t = line.t.at(i / 64.0);
      const Vec2 uv = image(t).C();
      line.gap = std::max(line.gap, line.curve->Value(t).Distance(carrier.geometry->Value(uv.x(), uv.y())));
    }
    boundary.lines.push_back(std::move(line));
  }
  return boundary;
}

bool on_border(const BoundaryLine& line, const SurfaceDomain& box) {
  for (const int d : {0, 1}) {
    const Interval range = d == 0 ? box.u : box.v;
    if (d == 0 ? box.u_closed : box.v_closed) continue;
    for (const double border : {range.lo, range.hi}) {
      bool on = true;
      for (int i = 0; i <= 32; ++i)
        on = on && std::abs(line.jet(line.t.at(i / 32.0)).C()[d] - border) <= 1e-7 * range.length();
      if (on) return true;
    }
  }
  return false;
}

}  // namespace blendwright::detail
