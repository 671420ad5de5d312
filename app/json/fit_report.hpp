#pragma once
// What a fit did, as JSON.
#include <string>

#include "app/json/job_keys.hpp"
#include "app/pipeline/fit_job.hpp"
#include "app/pipeline/staging.hpp"

namespace blendwright {

/// Version, input hash, and per blend what was asked, what changed, how well it is determined; no clock
/// readings unless `times`.
[[nodiscard]] std::string fit_report_json(const JobSpec& job, const FitJobResult& result,
                                          const std::vector<WrittenFile>& files, bool times);

/// Its objects; the first is the report itself.
[[nodiscard]] const std::vector<ObjectInfo>& fit_report_objects();
/// JSON Schema (draft 2020-12) of the report.
[[nodiscard]] std::string fit_report_schema();

}  // namespace blendwright
