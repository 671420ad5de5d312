// Edges of a part as one curve in the parameters of one surface, by arc length.
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernel/brep/edge_chain.hpp"
#include "kernel/brep/occt_geometry.hpp"
#include "kernel/brep/parameter_curves.hpp"
#include "kernel/geometry/spline_interpolation.hpp"

namespace blendwright {
namespace {

using detail::ChainLink;
using detail::EdgeChain;
using detail::FaceGeometry;
using detail::LinkCurve;
using detail::LinkPoint;

/// 5-point Gauss rule on [0, 1].
constexpr std::array<double, 5> gauss_x{0.046910077030668004, 0.23076534494715845, 0.5, 0.76923465505284155,
                                        0.953089922969332};
constexpr std::array<double, 5> gauss_w{0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                        0.23931433524968324, 0.11846344252809454};

/// The integral of a positive speed over [0, 1], and its inverse.
template <class Speed>
class Travel {
 public:
  Travel(Speed speed, std::size_t cells) : speed_(std::move(speed)), sum_(cells + 1, 0.0) {
    for (std::size_t i = 0; i < cells; ++i) sum_[i + 1] = sum_[i] + piece(left(i), left(i + 1));
  }
  [[nodiscard]] double total() const { return sum_.back(); }
  /// t at which the travelled length is s.
  [[nodiscard]] double at(double s) const {
    if (s <= 0.0) return 0.0;
    if (s >= total()) return 1.0;
    const auto above = std::upper_bound(sum_.begin(), sum_.end(), s);
    const auto i = std::min(static_cast<std::size_t>(above - sum_.begin()), sum_.size() - 1) - 1;
    double t = left(i) + (s - sum_[i]) / (sum_[i + 1] - sum_[i]) * (left(i + 1) - left(i));
    for (int k = 0; k < 8; ++k) {
      const double step = (s - sum_[i] - piece(left(i), t)) / speed_(t);
      t = std::clamp(t + step, left(i), left(i + 1));
      if (std::abs(step) < 1e-15) break;
    }
    return t;
  }

 private:
  [[nodiscard]] double left(std::size_t i) const {
    return static_cast<double>(i) / static_cast<double>(sum_.size() - 1);
  }
  [[nodiscard]] double piece(double a, double b) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < 5; ++k) sum += gauss_w[k] * speed_(a + (b - a) * gauss_x[k]);
    return sum * (b - a);
  }
  Speed speed_;
  std::vector<double> sum_;
};

/// The surface that carries the chain, in the geometry's own parameters.
FaceGeometry carrier(const StepPart::Impl& part, const EdgeChain& chain) {
  FaceGeometry g = detail::face_geometry(part.face(chain.links.front().face));
  bool several = false;
  for (const ChainLink& link : chain.links) {
    if (link.face == chain.links.front().face) continue;
    several = true;
    const FaceGeometry h = detail::face_geometry(part.face(link.face));
    // Parameters of h's corners on g: h may have another origin on the same surface.
    for (const double u : {h.box.u.lo, h.box.u.middle(), h.box.u.hi})
      for (const double v : {h.box.v.lo, h.box.v.hi}) {
        const auto uv = detail::elementary_parameters(g.geometry, detail::vec(h.geometry->Value(u, v)));
        if (!uv) continue;
        if (!g.geometry->IsUPeriodic())
          g.box.u = {std::min(g.box.u.lo, uv->x()), std::max(g.box.u.hi, uv->x())};
        if (!g.geometry->IsVPeriodic())
          g.box.v = {std::min(g.box.v.lo, uv->y()), std::max(g.box.v.hi, uv->y())};
      }
  }
  if (several && g.geometry->IsUPeriodic()) {
    g.box.u = {0.0, g.geometry->UPeriod()};
    g.box.u_closed = true;
  }
  if (several && g.geometry->IsVPeriodic()) {
    g.box.v = {0.0, g.geometry->VPeriod()};
    g.box.v_closed = true;
  }
  return g;
}

double wrapped(double x, double near, bool periodic, double period) {
  return periodic ? x + period * std::round((near - x) / period) : x;
}

/// Points of a chain in the parameters of its carrier, by edge length.
class ChainOnSurface {
 public:
  ChainOnSurface(const StepPart::Impl& part, const EdgeChain& chain, const FaceGeometry& carrier)
      : carrier_(carrier),
        elementary_(detail::elementary_parameters(carrier.geometry, Vec3::Zero()).has_value()) {
    for (const ChainLink& link : chain.links) {
      curves_.emplace_back(part, link);
      double first = 0, last = 0;
      pcurves_.push_back(BRep_Tool::CurveOnSurface(part.edge(link.edge), part.face(link.face), first, last));
      if (!elementary_ && pcurves_.back().IsNull())
        throw GeometryError("edge " + std::to_string(link.edge) + " has no curve on face " +
                            std::to_string(link.face));
      const LinkCurve& c = curves_.back();
      travels_.emplace_back([&part, link](double t) { return LinkCurve(part, link).at(t).C1.norm(); }, 64);
      start_.push_back(length_);
      length_ += travels_.back().total();
      (void)c;
    }
  }
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] std::size_t links() const { return curves_.size(); }
  [[nodiscard]] double start(std::size_t link) const { return link < start_.size() ? start_[link] : length_; }

  struct Place {
    std::size_t link = 0;
    double t = 0.0;
  };
  [[nodiscard]] Place place(double s) const {
    std::size_t i = 0;
    while (i + 1 < links() && s >= start_[i + 1]) ++i;
    return {i, travels_[i].at(s - start_[i])};
  }
  [[nodiscard]] LinkPoint edge_point(const Place& p) const { return curves_[p.link].at(p.t); }
  /// Parameters of the carrier next to the edge's point, taken on the branch next to `near`.
  [[nodiscard]] Vec2 uv(const Place& p, const Vec2& near) const {
    const auto& g = carrier_.geometry;
    const Vec2 x = elementary_ ? *detail::elementary_parameters(g, edge_point(p).C) : on_face(p);
    return {wrapped(x.x(), near.x(), g->IsUPeriodic(), g->IsUPeriodic() ? g->UPeriod() : 0.0),
            wrapped(x.y(), near.y(), g->IsVPeriodic(), g->IsVPeriodic() ? g->VPeriod() : 0.0)};
  }
  /// Tangent and curvature continue from the end of link i to the start of the next one.
  [[nodiscard]] bool smooth_after(std::size_t i) const {
    const LinkPoint a = curves_[i].at(1.0), b = curves_[(i + 1) % links()].at(0.0);
    const auto k = [](const LinkPoint& p) -> Vec3 { return p.C1.cross(p.C2) / std::pow(p.C1.norm(), 3); };
    return a.C1.normalized().cross(b.C1.normalized()).norm() < 1e-6 &&
           (k(a) - k(b)).norm() <= 1e-5 * (k(a).norm() + k(b).norm()) + 1e-9 / length_;
  }

 private:
  [[nodiscard]] Vec2 on_face(const Place& p) const {
    const gp_Pnt2d q = pcurves_[p.link]->Value(curves_[p.link].own(p.t));
    return {q.X(), q.Y()};
  }
  const FaceGeometry& carrier_;
  bool elementary_;
  std::vector<LinkCurve> curves_;
  std::vector<opencascade::handle<Geom2d_Curve>> pcurves_;
  std::vector<Travel<std::function<double(double)>>> travels_;
  std::vector<double> start_;
  double length_ = 0.0;
};

/// One piece of the trimline without corners: stations of the edge's length and their parameters.
struct Stations {
  std::vector<double> s;
  std::vector<Vec2> uv;
};

Stations stations(const ChainOnSurface& chain, double from, double to, std::size_t count, Vec2 near) {
  Stations r;
  for (std::size_t i = 0; i <= count; ++i) {
    // A piece ends on its own side of a corner: just inside the last link, never on the next.
    const double t = static_cast<double>(i) / static_cast<double>(count);
    const double s = from + (to - from) * t;
    ChainOnSurface::Place place = chain.place(i == count ? from + (to - from) * (1.0 - 1e-15) : s);
    if (i == count) place.t = 1.0;
    near = chain.uv(place, near);
    r.s.push_back(s);
    r.uv.push_back(near);
  }
  return r;
}

/// True when the stations lie on a line of constant speed, to `slack` in space.
bool is_line(const Stations& p, const FaceGeometry& g, double slack) {
  gp_Pnt q;
  gp_Vec du, dv;
  g.geometry->D1(p.uv.front().x(), p.uv.front().y(), q, du, dv);
  const Vec2 scale(du.Magnitude(), dv.Magnitude());
  const double length = p.s.back() - p.s.front();
  for (std::size_t i = 0; i < p.s.size(); ++i) {
    const Vec2 x = p.uv.front() + (p.s[i] - p.s.front()) / length * (p.uv.back() - p.uv.front());
    if ((p.uv[i] - x).cwiseProduct(scale).norm() > slack) return false;
  }
  return true;
}

/// A spline through the stations; closed ones may wind around closed directions.
detail::WindingSpline through(const Stations& p, bool closed) {
  const double length = p.s.back() - p.s.front();
  const Vec2 rate = closed ? Vec2((p.uv.back() - p.uv.front()) / length) : Vec2(Vec2::Zero());
  std::vector<Vec2> points;
  for (std::size_t i = 0; i + (closed ? 1 : 0) < p.s.size(); ++i)
    points.push_back(p.uv[i] - rate * (p.s[i] - p.s.front()));
  // A direction without any change is kept exactly constant: equal neighbours are no points of a curve
  // otherwise.
  return {interpolate_points<2>(points, p.s, closed, 5), rate};
}

/// The same curve with stations at equal arc lengths of its image on the surface.
Stations by_arc_length(const detail::WindingSpline& curve, const FaceGeometry& g, std::size_t count,
                       double start) {
  const CurveDomain d = curve.domain();
  const Travel travel(std::function<double(double)>([&](double t) {
                        const CurveJet<2> c = curve.jet(d.v.at(t));
                        gp_Pnt q;
                        gp_Vec du, dv;
                        g.geometry->D1(c.C().x(), c.C().y(), q, du, dv);
                        return (detail::vec(du) * c.C1().x() + detail::vec(dv) * c.C1().y()).norm() *
                               d.v.length();
                      }),
                      4 * count);
  Stations r;
  for (std::size_t i = 0; i <= count; ++i) {
    const double s = travel.total() * static_cast<double>(i) / static_cast<double>(count);
    r.s.push_back(start + s);
    r.uv.push_back(curve.jet(d.v.at(i == count ? 1.0 : travel.at(s))).C());
  }
  if (d.closed) r.uv.back() = r.uv.front() + curve.rate * d.v.length();
  return r;
}

/// Clamped pieces one after the other as one spline, with C0 knots between them.
BSplineCurve<2> joined(const std::vector<BSplineCurve<2>>& pieces, bool closed) {
  std::vector<double> breaks;
  std::vector<int> mults;
  std::vector<Vec2> control;
  const int degree = pieces.front().basis().degree();
  for (const BSplineCurve<2>& p : pieces) {
    const bool first = breaks.empty();
    if (!first) {
      breaks.pop_back();
      mults.pop_back();
      control.pop_back();
    }
    breaks.insert(breaks.end(), p.basis().breaks().begin(), p.basis().breaks().end());
    mults.insert(mults.end(), p.basis().multiplicities().begin(), p.basis().multiplicities().end());
    if (!first) mults[mults.size() - p.basis().multiplicities().size()] = degree;
    control.insert(control.end(), p.control().begin(), p.control().end());
  }
  if (closed) {
    mults.front() = mults.back() = degree;
    control.pop_back();
  }
  return {BSplineBasis(degree, std::move(breaks), std::move(mults), closed), std::move(control)};
}

BSplineCurve<2> without_drift(const BSplineCurve<2>& c, const Vec2& rate, double origin) {
  // Greville abscissae reproduce linear functions: subtracting rate * greville subtracts the line exactly.
  std::vector<Vec2> control = c.control();
  const std::vector<double> at = c.basis().greville();
  for (std::size_t i = 0; i < control.size(); ++i) control[i] -= rate * (at[i] - origin);
  return {c.basis(), std::move(control)};
}

/// The whole chain as pieces between corners.
Curve2 fit_chain(const ChainOnSurface& chain, const FaceGeometry& g, bool closed) {
  const Vec2 middle(g.box.u.middle(), g.box.v.middle());
  const double slack = 1e-10 * chain.length();
  const Stations probe = stations(chain, 0.0, chain.length(), 96, middle);
  if (is_line(probe, g, 10.0 * slack)) {
    const double length = chain.length();
    return detail::ParameterLine{
        probe.uv.front(), (probe.uv.back() - probe.uv.front()) / length, {{0.0, length}, closed}};
  }
  std::vector<double> corners{0.0};
  for (std::size_t i = 0; i + 1 < chain.links(); ++i)
    if (!chain.smooth_after(i)) corners.push_back(chain.start(i + 1));
  corners.push_back(chain.length());
  const bool periodic = closed && corners.size() == 2 && chain.smooth_after(chain.links() - 1);
  std::vector<BSplineCurve<2>> pieces;
  double s = 0.0;
  Vec2 near = middle;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    std::optional<detail::WindingSpline> best;
    for (std::size_t n = 64; n <= 1024; n *= 2) {
      const Stations rough = stations(chain, corners[i], corners[i + 1], n, near);
      const Stations even = by_arc_length(through(rough, periodic), g, n, s);
      detail::WindingSpline next = through(even, periodic);
      double change = 0.0;  // against half the stations, at equal arc lengths
      if (best)
        for (std::size_t k = 0; k <= 2 * n; ++k) {
          const double t = static_cast<double>(k) / static_cast<double>(2 * n);
          const Vec2 a = best->jet(best->domain().v.at(t)).C(), b = next.jet(next.domain().v.at(t)).C();
          change =
              std::max(change, g.geometry->Value(a.x(), a.y()).Distance(g.geometry->Value(b.x(), b.y())));
        }
      const bool done = best && change <= slack;
      best = std::move(next);
      if (done) break;
    }
    if (periodic) {
      if (best->rate.isZero(0.0)) return best->spline;
      return *best;
    }
    pieces.push_back(best->spline);
    s = best->domain().v.hi;
    near = best->jet(s).C();
  }
  if (!closed) return joined(pieces, false);
  const Vec2 rate = (pieces.back().control().back() - pieces.front().control().front()) / s;
  for (BSplineCurve<2>& p : pieces) p = without_drift(p, rate, 0.0);
  return detail::WindingSpline{joined(pieces, true), rate};
}

/// Largest distance from points of the edges to the curve's image at the same place along it.
double deviation(const ChainOnSurface& chain, const FaceGeometry& g, const Curve2& pcurve) {
  constexpr int samples = 509;
  double worst = 0.0;
  const Interval v = pcurve.domain().v;
  for (int i = 0; i <= samples; ++i) {
    const double t = static_cast<double>(i) / samples;
    const Vec2 uv = pcurve.point(v.at(t));
    const Vec3 on_surface = detail::vec(g.geometry->Value(uv.x(), uv.y()));
    ChainOnSurface::Place place = chain.place(t * chain.length());
    for (int k = 0; k < 4; ++k) {  // towards the nearest point of the edge
      const LinkPoint c = chain.edge_point(place);
      place.t = std::clamp(place.t + (on_surface - c.C).dot(c.C1) / c.C1.squaredNorm(), 0.0, 1.0);
    }
    worst = std::max(worst, (chain.edge_point(place).C - on_surface).norm());
  }
  return worst;
}

/// v -> -v of a reversed face, in the curve's parameters.
struct MirroredPcurve {
  Curve2 curve;
  [[nodiscard]] CurveJet<2> jet(double v) const {
    CurveJet<2> j = curve.jet(v);
    for (Vec2& d : j.D) d.y() = -d.y();
    return j;
  }
  [[nodiscard]] CurveDomain domain() const { return curve.domain(); }
};

Curve2 mirrored(const Curve2& curve) {
  if (const auto* line = curve.target<detail::ParameterLine>())
    return detail::ParameterLine{
        {line->start.x(), -line->start.y()}, {line->rate.x(), -line->rate.y()}, line->box};
  return MirroredPcurve{curve};
}

}  // namespace

EdgeTrimline StepPart::trimline(std::size_t face, std::size_t edge, bool chain) const {
  if (face >= impl_->faces.size() || edge >= impl_->edges.size())
    throw InputError("edge", "face " + std::to_string(face) + ", edge " + std::to_string(edge) +
                                 ": must be below " + std::to_string(impl_->faces.size()) + ", " +
                                 std::to_string(impl_->edges.size()));
  const EdgeInfo& info = impl_->edges[edge];
  if (std::find(info.faces.begin(), info.faces.end(), face) == info.faces.end())
    throw InputError("edge", "edge " + std::to_string(edge) + " is not on face " + std::to_string(face) +
                                 ", must be one of its border edges");
  return detail::guarded<GeometryError>("edge " + std::to_string(edge), [&] {
    const EdgeChain links = detail::edge_chain(*impl_, face, edge, chain);
    const FaceGeometry g = carrier(*impl_, links);
    const ChainOnSurface on_surface(*impl_, links, g);
    const Curve2 pcurve = fit_chain(on_surface, g, links.closed);
    EdgeTrimline result{detail::oriented_surface(g),
                        g.reversed ? mirrored(pcurve) : pcurve,
                        deviation(on_surface, g, pcurve),
                        links.kept_left,
                        {},
                        {}};
    for (const ChainLink& link : links.links) {
      result.edges.push_back(link.edge);
      if (std::find(result.faces.begin(), result.faces.end(), link.face) == result.faces.end())
        result.faces.push_back(link.face);
    }
    return result;
  });
}

}  // namespace blendwright
