#pragma once
// A fit as a report for people.
#include <filesystem>
#include <string>

#include "app/pipeline/fit_job.hpp"
#include "app/pipeline/staging.hpp"
#include "app/report/page.hpp"

namespace blendwright {

/// Verdict, objectives, parameters, convergence, how well the shape is determined. Figures are those of the
/// JSON report. `picture`: bytes of the fitted shape's picture, may be empty; `command`: how the program was
/// called.
[[nodiscard]] ReportPage fit_page(const JobSpec& job, const FitJobResult& result,
                                  const std::vector<WrittenFile>& files, const std::string& picture,
                                  const std::string& command);

}  // namespace blendwright
