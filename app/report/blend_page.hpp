#pragma once
// A job's result as a report for people.
#include <string>

#include "app/pipeline/write_outputs.hpp"
#include "app/report/page.hpp"

namespace blendwright {

/// Verdict, joints, plots along the trimlines, shape parameters, files and how to reproduce it. Figures are
/// those of the JSON report. `outputs` null: nothing was written. `picture`: bytes of the rendered result,
/// may be empty; `command`: how the program was called.
[[nodiscard]] ReportPage blend_page(const JobResult& result, const JobOutputs* outputs,
                                    const std::string& picture, const std::string& command);

/// How the figures were made: program, version, input and its hash, the call.
[[nodiscard]] PageSection reproduction(const std::string& program, const std::string& input,
                                       const std::string& hash, const std::string& command);

}  // namespace blendwright
