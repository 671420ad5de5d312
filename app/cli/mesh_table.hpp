#pragma once
// What a person reads of a mesh of a scene.
#include <string>

#include "app/cli/console.hpp"
#include "app/cli/text_table.hpp"
#include "app/pipeline/mesh_job.hpp"

namespace blendwright {

/// Its figures: what, and how much.
[[nodiscard]] TextRows mesh_rows(const SceneFile& scene, const MeshResult& result);
/// "the solid "body", "; empty for a node in place, which has no name that people know.
[[nodiscard]] std::string solid_name(const SceneFile& scene);
/// "wrote body.vtp (1.2 MB)", or that nothing was.
[[nodiscard]] std::string written_text(const std::vector<WrittenFile>& files);
/// Warnings of the scene and of the box, and notes.
void warn_of_mesh(const Console& console, const SceneFile& scene, const MeshResult& result);

struct MeshCommand;
/// The flags as a job. Throws InputError.
[[nodiscard]] MeshJob mesh_job_of(const MeshCommand& command);

}  // namespace blendwright
