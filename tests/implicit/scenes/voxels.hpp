#pragma once
// The topology of a solid from a grid of points.
#include <cstdint>
#include <vector>

#include "kernel/field/range.hpp"
#include "tests/implicit/scenes/example_scene.hpp"

namespace blendwright::test {

/// n^3 points of a box, ends included; inside[(k * n + j) * n + i].
struct Voxels {
  std::size_t n = 0;
  std::vector<std::uint8_t> inside;
};
[[nodiscard]] Voxels sample(const ScalarField& field, const Box& box, std::size_t n);
/// Points of a that are not in b.
[[nodiscard]] Voxels difference(const Voxels& a, const Voxels& b);

/// Of the complex of all points, edges, squares and cubes of the grid with all corners inside.
[[nodiscard]] long euler_characteristic(const Voxels& voxels);
/// Pieces that are connected along the grid's edges.
[[nodiscard]] std::size_t components(const Voxels& voxels);

}  // namespace blendwright::test
