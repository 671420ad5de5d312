#pragma once
// What `mesh` made, as JSON.
#include "app/json/json_value.hpp"
#include "app/pipeline/mesh_job.hpp"

namespace blendwright {

/// mesh_report_json() before it is text.
[[nodiscard]] JsonValue mesh_report(const SceneFile& scene, const MeshResult& result, bool times);

}  // namespace blendwright
