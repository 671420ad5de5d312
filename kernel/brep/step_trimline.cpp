// Edges of a part as one curve in the parameters of one surface, by arc length.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "kernel/brep/chain_on_surface.hpp"
#include "kernel/brep/face_boundary.hpp"
#include "kernel/brep/occt_geometry.hpp"
#include "kernel/brep/parameter_curves.hpp"
#include "kernel/brep/surface_kinks.hpp"
#include "kernel/geometry/spline_interpolation.hpp"

namespace blendwright {
namespace {

using detail::ChainLink;
using detail::ChainOnSurface;
using detail::EdgeChain;
using detail::FaceGeometry;
using detail::LinkPoint;

/// One piece of the trimline without corners: stations of the edge's length and their parameters.
struct Stations {
  std::vector<double> s;
  std::vector<Vec2> uv;
};

Stations stations(const ChainOnSurface& chain, double from, double to, std::size_t count, Vec2 near) {
  Stations r;
  for (std::size_t i = 0; i <= count; ++i) {
    const double s = from + (to - from) * static_cast<double>(i) / static_cast<double>(count);
    near = chain.uv(chain.place(s), near);
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
  if (!closed) return {interpolate_points<2>(p.uv, p.s, false, 5), Vec2::Zero()};
  const Vec2 rate = (p.uv.back() - p.uv.front()) / (p.s.back() - p.s.front());
  Eigen::MatrixXd rest(static_cast<Eigen::Index>(p.s.size() - 1), 2);
  for (std::size_t i = 0; i + 1 < p.s.size(); ++i)
    rest.row(static_cast<Eigen::Index>(i)) = (p.uv[i] - rate * (p.s[i] - p.s.front())).transpose();
  const BSplineBasis basis = BSplineBasis::closed(5, p.s);
  const Eigen::MatrixXd control = periodic_control(basis, rest);
  std::vector<Vec2> points;
  for (Eigen::Index i = 0; i < control.rows(); ++i) points.push_back(control.row(i).transpose());
  return {{basis, std::move(points)}, rate};
}

/// The same curve with stations at equal arc lengths of its image on the surface.
Stations by_arc_length(const detail::WindingSpline& curve, const FaceGeometry& g, std::size_t count,
                       double start) {
  const CurveDomain d = curve.domain();
  const detail::Travel travel(
      [&](double t) {
        const CurveJet<2> c = curve.jet(d.v.at(t));
        gp_Pnt q;
        gp_Vec du, dv;
        g.geometry->D1(c.C().x(), c.C().y(), q, du, dv);
        return (detail::vec(du) * c.C1().x() + detail::vec(dv) * c.C1().y()).norm() * d.v.length();
      },
      detail::refined({0.0, 1.0}, 4 * count));
  Stations r;
  for (std::size_t i = 0; i <= count; ++i) {
    const double s = travel.total() * static_cast<double>(i) / static_cast<double>(count);
    r.s.push_back(start + s);
    r.uv.push_back(curve.jet(d.v.at(i == count ? 1.0 : travel.at(s))).C());
  }
  if (d.closed) r.uv.back() = r.uv.front() + curve.rate * d.v.length();
  return r;
}

BSplineCurve<2> without_drift(const BSplineCurve<2>& c, const Vec2& rate, double origin) {
  // Greville abscissae reproduce linear functions: subtracting rate * greville subtracts the line exactly.
  std::vector<Vec2> control = c.control();
  const std::vector<double> at = c.basis().greville();
  for (std::size_t i = 0; i < control.size(); ++i) control[i] -= rate * (at[i] - origin);
  return {c.basis(), std::move(control)};
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

/// One smooth line that follows the chain as well as the part itself does: edges of imprecise parts meet at
/// small angles that are not meant, and that no smooth blend could follow. Empty when the edges are precise.
std::optional<Curve2> smoothed_chain(const ChainOnSurface& chain, const FaceGeometry& g, bool closed) {
  constexpr double exact = 1e-6, meant = 1.0 / 180.0 * std::numbers::pi;  // angle at a joint, radians
  const double turn = chain.sharpest_joint(closed).value;
  if (turn <= exact || turn >= meant) return std::nullopt;
  const Vec2 middle(g.box.u.middle(), g.box.v.middle());
  for (const std::size_t n : {32, 64, 128, 256}) {
    const Stations rough = stations(chain, 0.0, chain.length(), n, middle);
    const detail::WindingSpline line = through(by_arc_length(through(rough, closed), g, n, 0.0), closed);
    const Curve2 curve = line.rate.isZero(0.0) ? Curve2(line.spline) : Curve2(line);
    // The edge itself may be a tolerance away from the face.
    if (deviation(chain, g, curve) <= 2.0 * chain.tolerance()) return curve;
  }
  return std::nullopt;
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
  if (const auto line = smoothed_chain(chain, g, closed)) return *line;
  std::vector<double> corners = chain.corners();
  const std::vector<double> kinks = detail::surface_kinks(
      g.geometry, [&](double s) { return chain.uv(chain.place(s), middle); }, {0.0, chain.length()});
  corners.insert(corners.end(), kinks.begin(), kinks.end());
  corners.insert(corners.end(), {0.0, chain.length()});
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end(),
                            [&](double a, double b) { return b - a < 1e-6 * chain.length(); }),
                corners.end());
  const bool periodic = closed && corners.size() == 2 && chain.smooth_closing() &&
                        !detail::on_surface_kink(g.geometry, probe.uv.front());
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
  if (!closed) return detail::joined(pieces, false);
  const Vec2 rate = (pieces.back().control().back() - pieces.front().control().front()) / s;
  for (BSplineCurve<2>& p : pieces) p = without_drift(p, rate, 0.0);
  return detail::WindingSpline{detail::joined(pieces, true), rate};
}

/// v -> -v of a reversed face, in the curve's parameters.
struct MirroredPcurve {
  Curve2 curve;
  [[nodiscard]] CurveJet<2> jet(double v) const {
    CurveJet<2> j = curve.jet(v);
    for (Vec2& d : j.D) d.y() = -d.y();
    return j;
  }
  void enclose(const TaylorModel& v, CurveEnclosure& out) const {
    if (!curve.enclose(v, out)) out.unproven = "the edge's curve has no enclosure";
    for (ModelVector& d : out.D) d[1] = -d[1];
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
    FaceGeometry g = detail::carrier(*impl_, links);
    std::set<std::size_t> group;
    for (const ChainLink& link : links.links) group.insert(link.face);
    g.boundary = std::make_shared<const detail::FaceBoundary>(detail::face_boundary(*impl_, group, g));
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
