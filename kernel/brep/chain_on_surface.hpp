#pragma once
// Private: a chain of edges in the parameters of the one surface that carries it.
#include <Geom2d_Curve.hxx>
#include <vector>

#include "kernel/brep/edge_chain.hpp"
#include "kernel/brep/occt_surface.hpp"
#include "kernel/brep/travel.hpp"

namespace blendwright::detail {

/// The surface that carries the chain, in the geometry's own parameters.
[[nodiscard]] FaceGeometry carrier(const StepPart::Impl& part, const EdgeChain& chain);

/// Points of a chain in the parameters of its carrier, by length along the edges. Refers to the part.
class ChainOnSurface {
 public:
  ChainOnSurface(const StepPart::Impl& part, const EdgeChain& chain, const FaceGeometry& carrier);
  [[nodiscard]] double length() const { return length_; }

  struct Place {
    std::size_t link = 0;
    double t = 0.0;
  };
  [[nodiscard]] Place place(double s) const;
  [[nodiscard]] LinkPoint edge_point(const Place& p) const { return curves_[p.link].at(p.t); }
  /// Parameters of the carrier next to the edge's point, taken on the branch next to `near`.
  [[nodiscard]] Vec2 uv(const Place& p, const Vec2& near) const;
  /// Lengths, strictly inside, where the tangent or the curvature jumps.
  [[nodiscard]] std::vector<double> corners() const;
  /// The largest angle between the tangents of two edges that meet, 0 with one open edge.
  [[nodiscard]] Radians sharpest_joint(bool closed) const;
  /// Largest tolerance that the part states for its edges.
  [[nodiscard]] double tolerance() const { return tolerance_; }
  [[nodiscard]] bool smooth_closing() const {
    return smooth(curves_.back().at(1.0), curves_.front().at(0.0));
  }

 private:
  [[nodiscard]] Vec2 on_face(const Place& p) const;
  [[nodiscard]] bool smooth(const LinkPoint& a, const LinkPoint& b) const;
  FaceGeometry carrier_;
  bool elementary_;
  std::vector<LinkCurve> curves_;
  std::vector<opencascade::handle<Geom2d_Curve>> pcurves_;
  std::vector<Travel> travels_;
  std::vector<double> start_;
  double length_ = 0.0, tolerance_ = 0.0;
};

}  // namespace blendwright::detail
