#pragma once
// Private: the edges around a face of a part, in the parameters of the surface that carries it.
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <functional>
#include <set>
#include <vector>

#include "kernel/brep/occt_surface.hpp"
#include "kernel/brep/step_part_impl.hpp"
#include "kernel/geometry/curve.hpp"

namespace blendwright::detail {

/// One edge that bounds a face.
struct BoundaryLine {
  opencascade::handle<Geom_Curve> curve;  ///< in the part's coordinates
  Interval t;
  std::function<CurveJet<2>(double)> jet;  ///< parameters of the geometry at curve(t), not wrapped
  bool kept_left = true;                   ///< of growing t, in those parameters
  std::vector<double> breaks;  ///< t where the curve has less than three derivatives, both ends included
  double gap = 0.0;            ///< largest distance from the curve to its image on the surface
};

struct FaceBoundary {
  std::vector<BoundaryLine> lines;
};

/// The edges around a group of faces on one surface; edges between two faces of the group, and seams, are
/// none.
[[nodiscard]] FaceBoundary face_boundary(const StepPart::Impl& part, const std::set<std::size_t>& group,
                                         const FaceGeometry& carrier);

/// Whether the line runs along one side of the parameter box.
[[nodiscard]] bool on_border(const BoundaryLine& line, const SurfaceDomain& box);

}  // namespace blendwright::detail
