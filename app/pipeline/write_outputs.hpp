#pragma once
// JobResult -> files; the STEP file is read back and verified as the stage "step".
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/pipeline/run_job.hpp"
#include "app/pipeline/staging.hpp"

namespace blendwright {

struct JobOutputs {
  std::vector<WrittenFile> files;
  std::optional<StepContent> step;  ///< as read back
  std::string not_joined;           ///< why the faces could not be joined to a shape; empty: they were
  std::vector<std::string> notes;   ///< e.g. "pictures skipped: no X display and Xvfb is not installed"
};

struct WriteOptions {
  std::filesystem::path folder = "out";
  bool overwrite = false;  ///< false: an existing file of a result's name is an IoError before any writing
  bool times = false;      ///< stage times in the report (two runs then differ)
};

/// Writes the formats the job asks for and report.json ("<name>.report.json"); each file under a temporary
/// name first. Adds the stage "step" to `result`. Throws IoError, leaving no half-written file.
[[nodiscard]] JobOutputs write_outputs(JobResult& result, const WriteOptions& options,
                                       const Progress& progress = {});

/// What is wrong with the shape that was written: joining, validity, free trimline edges, largest tolerance.
[[nodiscard]] std::vector<std::string> shape_problems(const JobResult& result, const JobOutputs& outputs);

/// True when every blend reaches what was asked of it at its last measured stage, the shape checks pass, and
/// both measurements of every figure agree.
[[nodiscard]] bool verified(const JobResult& result, const JobOutputs* outputs = nullptr);

}  // namespace blendwright
