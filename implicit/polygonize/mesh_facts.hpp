#pragma once
// Measures of a triangle mesh.
#include <cstdint>
#include <span>
#include <vector>

#include "implicit/polygonize/polygonize.hpp"

namespace blendwright::detail {

/// Sums over fixed chunks in fixed order: the same bits for any number of threads. The volume is that of the
/// solid that a closed mesh bounds, by the divergence theorem about `centre`.
struct AreaAndVolume {
  double area = 0.0, volume = 0.0;
};
[[nodiscard]] AreaAndVolume area_and_volume(const TriMesh& mesh, const Vec3& centre);

/// Number of connected pieces; points without a triangle are pieces too.
[[nodiscard]] std::size_t components_of(const TriMesh& mesh);

/// Largest and mean |distance| over the numbers that are not NaN.
struct DistanceSummary {
  double largest = 0.0, mean = 0.0;
};
[[nodiscard]] DistanceSummary summary_of(std::span<const double> distances);

/// Where a normal is zero: the mean of the faces around the vertex instead. Returns how many there were.
std::size_t fill_missing_normals(TriMesh& mesh);

}  // namespace blendwright::detail
