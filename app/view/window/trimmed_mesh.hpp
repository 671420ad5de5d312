#pragma once
// Private: the part of a primary that a blend keeps, for drawing: triangles cut along trimlines.
#include <vector>

#include "kernel/mesh/mesh.hpp"

namespace blendwright {

/// A trimline as points, each with a direction within the primary into the part that stays.
struct KeptSide {
  std::vector<Vec3> points, inward;
};

/// `mesh` without what lies on the far side of a line. Cuts run straight through triangles: right to the
/// mesh's own fineness.
[[nodiscard]] TriMesh trimmed_mesh(const TriMesh& mesh, const std::vector<KeptSide>& lines);

}  // namespace blendwright
