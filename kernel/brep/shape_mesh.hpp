#pragma once
// Triangles of a shape's trimmed faces: what mesh files and pictures show.
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

}  // namespace blendwright
