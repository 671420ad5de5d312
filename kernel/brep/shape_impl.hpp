#pragma once
// Private: what a Shape holds.
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <array>
#include <optional>

#include "kernel/brep/shape.hpp"

namespace blendwright {

struct ShapeFace {
  TopoDS_Face face;
  std::string name;
  std::optional<Colour> colour;
  bool blend = false;                      ///< u = lo and u = hi are trimlines
  std::array<bool, 2> joined{true, true};  ///< the trimline at u = lo, u = hi has a primary
};

struct Shape::Impl {
  TopoDS_Shape shape;
  std::vector<ShapeFace> faces;  ///< oriented as in the shape, in its order
};

}  // namespace blendwright
