#pragma once
// Triangles of a shape's trimmed faces: what mesh files and pictures show.
#include <functional>
#include <string>
#include <vector>

#include "kernel/brep/shape.hpp"
#include "kernel/mesh/mesh.hpp"

namespace blendwright {

/// One mesh per face, in the order of the shape, named as the face. Neighbouring faces have the same points
/// along their common edge, so that the meshes together are as watertight as the shape. Normals point
/// outwards; columns u, v (surface parameters of the CAD kernel), mean_curvature, gaussian_curvature (1/unit;
/// signs belong to the normal).
/// @param chord  largest distance between triangles and surface, model units
/// @param angle  largest turn of the normal along a triangle's edge
[[nodiscard]] std::vector<TriMesh> tessellate(const Shape& shape, double chord, Radians angle);

/// The same of the faces with a name that `wanted` accepts, without the time that the others take.
[[nodiscard]] std::vector<TriMesh> tessellate(const Shape& shape, double chord, Radians angle,
                                              const std::function<bool(const std::string& name)>& wanted);

/// A face of a shape: its name, and whether its outward side is that of -(Su x Sv).
struct FaceSide {
  std::string name;
  bool reversed = false;
};
[[nodiscard]] std::vector<FaceSide> sides_of_faces(const Shape& shape);

}  // namespace blendwright
