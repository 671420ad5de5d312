#pragma once
// Where a report for people is written, and the pictures in it.
#include <filesystem>
#include <string>
#include <vector>

#include "app/pipeline/fit_job.hpp"
#include "app/pipeline/mesh_job.hpp"
#include "app/pipeline/write_outputs.hpp"
#include "app/report/page.hpp"

namespace blendwright {

/// Before the work: throws InputError ("--report") when the name does not end in .html, IoError when the file
/// is there and may not be replaced, or its folder is missing.
void require_report_place(const std::filesystem::path& file, bool overwrite);

/// The page of the job's result, with its picture: that of the outputs when there is one, else one of its
/// own. Adds a note to `notes` when there is no display for it. Throws IoError, leaving no half-written file.
void write_blend_report(const std::filesystem::path& file, const JobResult& result, const JobOutputs* outputs,
                        const std::string& command, std::vector<std::string>& notes);
/// The same for a fit of `job`; the picture shows how far the blends moved.
void write_fit_report(const std::filesystem::path& file, const JobSpec& job, const FitJobResult& result,
                      const std::vector<WrittenFile>& files, const std::string& command,
                      std::vector<std::string>& notes);
/// The same for a mesh of a scene.
void write_mesh_report(const std::filesystem::path& file, const SceneFile& scene, const MeshResult& result,
                       const std::string& command, std::vector<std::string>& notes);

}  // namespace blendwright
