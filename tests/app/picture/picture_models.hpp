#pragma once
// Surfaces and inputs whose figures are known.
#include <cmath>
#include <numbers>

#include "app/pipeline/picture_job.hpp"
#include "kernel/primitives/primary.hpp"

namespace blendwright::test {

/// Sphere of radius r about the origin: normals outward, mean curvature 1/r (convex positive), Gaussian
/// 1/r^2.
inline TriMesh ball(double r, int rows = 24, int columns = 48) {
  TriMesh mesh;
  mesh.name = "ball";
  Column mean{"mean_curvature", "1/mm", 1, {}}, gaussian{"gaussian_curvature", "1/mm^2", 1, {}};
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double t = std::numbers::pi * i / rows, p = 2.0 * std::numbers::pi * j / columns;
      const Vec3 n(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t));
      mesh.points.push_back(r * n);
      mesh.normals.push_back(n);
      mean.values.push_back(1.0 / r);
      gaussian.values.push_back(1.0 / (r * r));
      if (i == rows) continue;
      const auto at = [&](int a, int b) {  // one point for each pole
        return static_cast<std::uint32_t>(a * columns + (a == 0 || a == rows ? 0 : b % columns));
      };
      if (i + 1 < rows) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  mesh.columns = {mean, gaussian};
  return mesh;
}

inline PictureInput input_of(TriMesh mesh, const std::string& name = "ball") {
  PictureInput input;
  input.name = name;
  input.unit = LengthUnit::millimetre;
  input.parts.push_back({PicturePart::Role::other, std::move(mesh), {}});
  return input;
}

inline PictureJob showing(Show show) {
  PictureJob job;
  job.show = show;
  return job;
}

}  // namespace blendwright::test
