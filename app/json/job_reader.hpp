#pragma once
// Job files: JSON with comments -> JobSpec. The only door to the JSON library is app/json.
#include <filesystem>
#include <string>
#include <string_view>

#include "app/pipeline/job.hpp"
#include "app/pipeline/write_outputs.hpp"

namespace blendwright {

/// Throws InputError with every problem of the text at once, each with its JSON pointer in the order of the
/// file; a syntax error names line and column. `file` gives the job's name and folder. Unknown keys are
/// errors with a suggestion; text over 64 MB or nested deeper than 64 levels is refused before parsing.
[[nodiscard]] JobSpec read_job(std::string_view text, const std::filesystem::path& file);
/// Reads the file ("-": standard input). IoError when it cannot be read.
[[nodiscard]] JobSpec read_job_file(const std::filesystem::path& file);

/// JSON Schema (draft 2020-12) of a job and of a report.
[[nodiscard]] std::string job_schema();
[[nodiscard]] std::string report_schema();

/// report.json: version, input hash, verdict, and per blend, side and stage every figure with its place. No
/// clock readings unless `times` (so that two runs give the same bytes).
[[nodiscard]] std::string report_json(const JobResult& result, const JobOutputs* outputs, bool times);

}  // namespace blendwright
