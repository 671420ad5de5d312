#pragma once
// What a blend is to keep clear of, and what it is to come close to: read from files.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "parametric/shape_fit/shape_fit.hpp"

namespace blendwright {

/// Distance to the surface of an obstacle with its gradient; may be called from several threads. Meshes: of
/// closed, oriented ones negative inside; of others the distance alone. Scenes: -phi / |grad phi|, the
/// distance to first order.
using Obstacle = std::function<ObstacleSample(const Vec3&)>;

/// `place`: "part.stl" (.vtp, .ply, .obj) or "scene.json", "scene.json#node", relative to `folder`; lengths
/// of a scene must be in `unit`. Throws IoError, InputError.
[[nodiscard]] Obstacle read_obstacle(const std::string& place, const std::filesystem::path& folder,
                                     LengthUnit unit);

/// The points of a .csv, or of a mesh. Throws IoError; InputError when there are none, or one is not finite.
[[nodiscard]] std::vector<Vec3> read_scan(const std::string& place, const std::filesystem::path& folder);

}  // namespace blendwright
