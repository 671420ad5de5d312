#pragma once
// A mesh of a scene as a report for people.
#include <string>

#include "app/pipeline/mesh_job.hpp"
#include "app/report/page.hpp"

namespace blendwright {

/// `picture`: bytes of the rendered mesh, may be empty; `command`: how the program was called.
[[nodiscard]] ReportPage mesh_page(const SceneFile& scene, const MeshResult& result,
                                   const std::string& picture, const std::string& command);

}  // namespace blendwright
