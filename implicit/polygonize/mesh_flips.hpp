#pragma once
// Swapping diagonals: two faces with a common edge become the other two faces of their four vertices.
#include <functional>
#include <vector>

#include "implicit/polygonize/connectivity.hpp"

namespace blendwright::detail {

/// For each of `faces` (numbers of triangles) in turn: if it is not acceptable (any more), swaps the diagonal
/// with the first neighbour that makes two acceptable faces and an edge that is not there yet. The mesh stays
/// closed and keeps its numbers of faces and edges. `acceptable` gets the number of a face and the vertices
/// that it has or may get.
void flip_unacceptable_faces(std::vector<Triangle>& triangles, std::size_t points,
                             const std::vector<std::size_t>& faces,
                             const std::function<bool(std::size_t, const Triangle&)>& acceptable);

}  // namespace blendwright::detail
