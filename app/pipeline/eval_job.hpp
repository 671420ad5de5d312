#pragma once
// A scene's field at given points.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/json/scene_reader.hpp"
#include "kernel/mesh/mesh.hpp"

namespace blendwright {

struct FieldSample {
  Vec3 point;
  double value = 0.0;
  bool inside = false;  ///< within the solid or on its surface
  Vec3 gradient = Vec3::Zero();
  std::optional<LevelCurvature> curvature{};  ///< none where the level surface has no normal
  std::optional<std::uint32_t> member{};      ///< index of the nearest primitive; none when there are none
};

/// On all cores; the same for any number of threads.
[[nodiscard]] std::vector<FieldSample> samples_at(const ScalarField& field, std::span<const Vec3> points);

/// Lines of comma separated values; what is not defined is empty, names with commas or quotes are in quotes.
[[nodiscard]] std::string csv_header();
[[nodiscard]] std::string csv_lines(std::span<const FieldSample> samples,
                                    const std::vector<std::string>& members);
/// The samples as objects of a JSON array, without its brackets; what is not defined is null.
[[nodiscard]] std::string json_objects(std::span<const FieldSample> samples,
                                       const std::vector<std::string>& members);
/// The points with everything as columns; what is not defined is NaN, no member is -1.
[[nodiscard]] TriMesh sample_cloud(const SceneFile& scene, std::span<const FieldSample> samples);

}  // namespace blendwright
