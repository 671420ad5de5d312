#pragma once
// Which files a job writes.
#include <filesystem>
#include <vector>

#include "app/pipeline/run_job.hpp"
#include "kernel/brep/shape.hpp"

namespace blendwright {

[[nodiscard]] bool wants(const JobResult& result, OutputFormat format);

/// Names of everything that will be written; an empty path is not wanted.
struct OutputPlan {
  std::filesystem::path step, picture, plots, stl, obj, report;
  std::vector<std::filesystem::path> blend_meshes, primary_meshes, trimlines;
  [[nodiscard]] std::vector<std::filesystem::path> all() const;
};
[[nodiscard]] OutputPlan plan_outputs(const JobResult& result, const Assembly& assembly,
                                      const std::filesystem::path& folder);

}  // namespace blendwright
