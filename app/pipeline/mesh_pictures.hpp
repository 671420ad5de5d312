#pragma once
// Pictures of meshes of scenes.
#include <filesystem>
#include <string>
#include <vector>

#include "app/json/scene_reader.hpp"
#include "kernel/mesh/mesh.hpp"

namespace blendwright {

/// `colour`: the column that colours the surface; empty: plain. Curvatures are shown between their 2nd and
/// 98th percentile, since creases have any; distance errors by magnitude on a logarithmic scale. Without a
/// display nothing is written and a note says so.
void write_mesh_picture(const std::filesystem::path& png, const SceneFile& scene, const TriMesh& mesh,
                        const std::string& colour, std::vector<std::string>& notes);

}  // namespace blendwright
