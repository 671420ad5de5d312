#pragma once
// Private: the face of a blend and its two trimline borders.
#include <Geom_BSplineCurve.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <array>
#include <vector>

#include "kernel/brep/face_builder.hpp"
#include "kernel/brep/shape.hpp"

namespace blendwright::detail {

/// The border u = 0 or u = 1 of a blend: one 3-D curve, cut into edges where a primary needs it.
struct BlendBorder {
  opencascade::handle<Geom_BSplineCurve> curve;
  std::vector<double> breaks;
  Interval v;
  bool returns = false;            ///< ends where it starts
  bool point = false;              ///< has no length
  std::vector<Interval> pieces;    ///< of v, in order
  std::vector<TopoDS_Edge> edges;  ///< one per piece
};

[[nodiscard]] BlendBorder blend_border(const BSplineSurface& blend, int side, double tolerance);
/// Makes the edges of the pieces; the border's ends come from `corners`.
void make_edges(BlendBorder& border, VertexPool& corners);

/// One face, periodic in v when the blend is closed; its seam, or its two side edges, are made here.
[[nodiscard]] TopoDS_Face blend_face(const BSplineSurface& blend, const std::array<BlendBorder, 2>& borders,
                                     double tolerance);

}  // namespace blendwright::detail
