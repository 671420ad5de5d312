#pragma once
// Private: faces that share edges become shells and solids.
#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

#include "kernel/brep/shape_impl.hpp"

namespace blendwright::detail {

/// One shell per connected set of faces, a solid where it closes; faces are turned so that neighbours agree,
/// starting from the first primary of each set. Several sets become a compound.
[[nodiscard]] Shape::Impl build_shells(std::vector<ShapeFace> faces, std::vector<std::string>& warnings);

}  // namespace blendwright::detail
