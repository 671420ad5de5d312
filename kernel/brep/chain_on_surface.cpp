#include "kernel/brep/chain_on_surface.hpp"

#include <BRep_Tool.hxx>
#include <Geom_SphericalSurface.hxx>
#include <cmath>
#include <numbers>

#include "kernel/base/error.hpp"
#include "kernel/brep/occt_geometry.hpp"

namespace blendwright::detail {
namespace {

/// A sphere's parameters fail at its poles, and the axis of a sphere is arbitrary: where the edges come near
/// a pole, the axis is turned to the normal of the first edge's plane, on which circles are lines of constant
/// latitude.
void avoid_poles(const StepPart::Impl& part, const EdgeChain& chain, FaceGeometry& g) {
  const auto sphere = opencascade::handle<Geom_SphericalSurface>::DownCast(g.geometry);
  if (sphere.IsNull()) return;
  constexpr double near_pole = 1.3;  // latitude, radians
  double highest = 0.0;
  for (const ChainLink& link : chain.links)
    for (int i = 0; i <= 64; ++i)
      highest = std::max(
          highest, std::abs(elementary_parameters(g.geometry, LinkCurve(part, link).at(i / 64.0).C)->y()));
  if (highest < near_pole) return;
  const LinkCurve first(part, chain.links.front());
  const Vec3 a = first.at(0.0).C, n = (first.at(0.33).C - a).cross(first.at(0.66).C - a);
  if (n.norm() <= 1e-9 * sphere->Radius() * sphere->Radius()) return;
  if (!sphere->Position().Direct()) g.reversed = !g.reversed;
  g.geometry =
      new Geom_SphericalSurface(gp_Ax3(sphere->Location(), gp_Dir(n.x(), n.y(), n.z())), sphere->Radius());
  g.box = {{0.0, 2.0 * std::numbers::pi}, {-0.5 * std::numbers::pi, 0.5 * std::numbers::pi}, true, false};
}

double wrapped(double x, double near, bool periodic, double period) {
  return periodic ? x + period * std::round((near - x) / period) : x;
}

}  // namespace

FaceGeometry carrier(const StepPart::Impl& part, const EdgeChain& chain) {
  FaceGeometry g = face_geometry(part.face(chain.links.front().face));
  bool several = false;
  for (const ChainLink& link : chain.links) {
    if (link.face == chain.links.front().face) continue;
    several = true;
    const FaceGeometry h = face_geometry(part.face(link.face));
    // Parameters of h's corners on g: h may have another origin on the same surface.
    for (const double u : {h.box.u.lo, h.box.u.middle(), h.box.u.hi})
      for (const double v : {h.box.v.lo, h.box.v.hi}) {
        const auto uv = elementary_parameters(g.geometry, vec(h.geometry->Value(u, v)));
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
  avoid_poles(part, chain, g);
  return g;
}

ChainOnSurface::ChainOnSurface(const StepPart::Impl& part, const EdgeChain& chain,
                               const FaceGeometry& carrier)
    : carrier_(carrier), elementary_(elementary_parameters(carrier.geometry, Vec3::Zero()).has_value()) {
  for (const ChainLink& link : chain.links) {
    curves_.emplace_back(part, link);
    double first = 0, last = 0;
    pcurves_.push_back(BRep_Tool::CurveOnSurface(part.edge(link.edge), part.face(link.face), first, last));
    if (!elementary_ && pcurves_.back().IsNull())
      throw GeometryError("edge " + std::to_string(link.edge) + " has no curve on face " +
                          std::to_string(link.face));
    const std::vector<double> breaks = curves_.back().breaks();
    travels_.emplace_back([&part, link](double t) { return LinkCurve(part, link).at(t).C1.norm(); },
                          refined(breaks, std::max<std::size_t>(4, 64 / breaks.size())));
    start_.push_back(length_);
    length_ += travels_.back().total();
    tolerance_ = std::max(tolerance_, BRep_Tool::Tolerance(part.edge(link.edge)));
  }
}

ChainOnSurface::Place ChainOnSurface::place(double s) const {
  std::size_t i = 0;
  while (i + 1 < curves_.size() && s >= start_[i + 1]) ++i;
  return {i, travels_[i].at(s - start_[i])};
}

Vec2 ChainOnSurface::uv(const Place& p, const Vec2& near) const {
  const auto& g = carrier_.geometry;
  const Vec2 x = elementary_ ? *elementary_parameters(g, edge_point(p).C) : on_face(p);
  return {wrapped(x.x(), near.x(), g->IsUPeriodic(), g->IsUPeriodic() ? g->UPeriod() : 0.0),
          wrapped(x.y(), near.y(), g->IsVPeriodic(), g->IsVPeriodic() ? g->VPeriod() : 0.0)};
}

std::vector<double> ChainOnSurface::corners() const {
  std::vector<double> found;
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    constexpr double aside = 1e-7;  // of the edge, to see the two limits at a break
    for (const double t : curves_[i].breaks())
      if (t > aside && t < 1.0 - aside && !smooth(curves_[i].at(t - aside), curves_[i].at(t + aside)))
        found.push_back(start_[i] + travels_[i].length_at(t));
    if (i + 1 < curves_.size() && !smooth(curves_[i].at(1.0), curves_[i + 1].at(0.0)))
      found.push_back(start_[i + 1]);
  }
  return found;
}

Radians ChainOnSurface::sharpest_joint(bool closed) const {
  double worst = 0.0;
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    if (i + 1 == curves_.size() && !closed) break;
    const Vec3 a = curves_[i].at(1.0).C1, b = curves_[(i + 1) % curves_.size()].at(0.0).C1;
    worst = std::max(worst, std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  return Radians(worst);
}

Vec2 ChainOnSurface::on_face(const Place& p) const {
  // The edge's curve in space is the part's own statement. The parameter curve was often made by the reader,
  // and is only a first guess: millimetres off have been seen on edges whose stated tolerance is 1e-7.
  const gp_Pnt2d guess = pcurves_[p.link]->Value(curves_[p.link].own(p.t));
  return foot_near(carrier_.geometry, edge_point(p).C, {guess.X(), guess.Y()});
}

bool ChainOnSurface::smooth(const LinkPoint& a, const LinkPoint& b) const {
  const auto k = [](const LinkPoint& p) -> Vec3 { return p.C1.cross(p.C2) / std::pow(p.C1.norm(), 3); };
  return a.C1.normalized().cross(b.C1.normalized()).norm() < 1e-6 &&
         (k(a) - k(b)).norm() <= 1e-5 * (k(a).norm() + k(b).norm()) + 1e-9 / length_;
}

}  // namespace blendwright::detail
