#pragma once
// Private: the parameter curve of a shared edge on a primary.
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <functional>
#include <vector>

#include "kernel/brep/primary_geometry.hpp"
#include "kernel/geometry/curve.hpp"

namespace blendwright::detail {

struct CutPcurve {
  opencascade::handle<Geom2d_Curve> curve;
  double gap = 0.0;  ///< largest distance, at equal parameters, between its image and the edge
};

/// A curve p with G(p(v)) = edge(v) over `range`: the cut itself where it is a straight line of constant
/// speed, else its quintic spline, refined until it adds at most `slack` to the distance that the cut itself
/// has from the edge.
/// @param cut     the trimline in the parameters of G, with derivatives
/// @param corners where the cut itself is not smooth, beside knots of the surface; ends allowed
/// @param breaks  where the edge's own polynomial pieces meet
[[nodiscard]] CutPcurve cut_pcurve(const std::function<CurveJet<2>(double)>& cut, const Interval& range,
                                   const std::vector<double>& breaks,
                                   const opencascade::handle<Geom_Curve>& edge,
                                   const opencascade::handle<Geom_Surface>& surface, double slack,
                                   const std::vector<double>& corners = {});

}  // namespace blendwright::detail
