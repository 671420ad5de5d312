#pragma once
// Boundary representation of a result: the blends and the trimmed primaries, sharing their edges.
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernel/brep/step_part.hpp"
#include "kernel/geometry/bspline.hpp"

namespace blendwright {

struct Colour {
  double r = 0.7, g = 0.7, b = 0.7;
};

/// One trimline of a primary: where it runs in the primary's parameters and which side stays.
struct PrimaryCut {
  Curve2 pcurve;          ///< on the blend's v
  bool kept_left = true;  ///< kept part towards n x C'
  std::size_t blend = 0;  ///< index into Assembly::blends
  int side = 0;           ///< 0: u = 0 edge of that blend, 1: u = 1 edge
};

struct PrimaryPatch {
  std::string name;
  Surface surface;
  std::vector<PrimaryCut> cuts;
  Colour colour{0.72, 0.75, 0.80};
};

struct BlendPatch {
  std::string name;
  BSplineSurface surface;  ///< u in [0, 1] across, v along; periodic in v when closed
  Colour colour{0.90, 0.55, 0.15};
};

struct Assembly {
  std::vector<BlendPatch> blends;
  std::vector<PrimaryPatch> primaries;
};

/// A shell or solid, as an immutable value over the CAD kernel's shape.
class Shape {
 public:
  struct Impl;
  explicit Shape(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  [[nodiscard]] const Impl& impl() const { return *impl_; }

 private:
  std::shared_ptr<const Impl> impl_;
};

/// Builds one shell (a solid when it closes): each blend is one face, its trimline edges are the primaries'
/// edges (one edge, one 3-D curve, two pcurves), never sewn. Primaries keep their own STEP entity where there
/// is one (plane, circular cylinder, cone, sphere, torus, B-spline), else a B-spline within `tolerance` /
/// 100. A primary that is a face of a part keeps that face's own edges (outer border, holes), except those
/// that a trimline replaces or removes; where they cannot be kept the warnings say so. The part's other faces
/// are not in the shape. A primary whose trimline does not divide its domain is cut by straight parameter
/// lines to the nearest border, which the warnings say. Throws GeometryError when an edge cannot be closed
/// within `tolerance`.
struct AssemblyResult {
  Shape shape;
  std::vector<std::string> warnings;
};
[[nodiscard]] AssemblyResult assemble(const Assembly& assembly, double tolerance);

/// What the CAD kernel says of the shape, measured, not believed: see also verify.
struct ShapeCheck {
  bool valid = false;              ///< BRepCheck on every sub-shape
  double largest_tolerance = 0.0;  ///< over vertices, edges, faces
  double largest_edge_gap =
      0.0;  ///< largest measured distance between an edge's curve and its pcurves on their faces
  std::size_t faces = 0, shells = 0, solids = 0;
  std::size_t free_edges = 0;  ///< edges of one face only (degenerated edges and seams not counted)
  std::size_t unexpected_free_edges = 0;  ///< free edges that lie on a blend's trimline
  double area = 0.0;
  std::vector<std::string> problems;
};
[[nodiscard]] ShapeCheck check_shape(const Shape& shape);

}  // namespace blendwright
