#pragma once
// JobSpec -> JobResult: one function, no state.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/pipeline/job.hpp"
#include "app/pipeline/stage_time.hpp"
#include "kernel/base/progress.hpp"
#include "parametric/fit/blend_fit.hpp"
#include "verify/report/blend_report.hpp"

namespace blendwright {

struct BlendResult {
  BlendEntry entry;
  Blend blend;   ///< exact
  BlendFit fit;  ///< exported
  std::array<std::optional<Surface>, 2> primaries;
  std::vector<BlendReport> stages;  ///< formula, fitted; write_outputs adds step
};

struct RunOptions {
  bool certify = false;                       ///< prove bounds between the samples at every stage
  std::optional<FairnessOptions> fairness{};  ///< measure fairness at every stage
};

struct JobResult {
  JobSpec job;
  RunOptions options{};
  std::vector<std::pair<std::string, Surface>> primaries;
  std::vector<BlendResult> blends;
  std::vector<std::string> warnings;
  std::vector<StageTime> times;
};

/// What a fit is asked for: a part of the tolerance, so that files and re-reading have the rest.
[[nodiscard]] BlendFitOptions fit_options(const Tolerance& tolerance);

/// Builds, fits and verifies every blend of the job, in memory. Throws InputError (JSON pointers, all
/// problems at once), GeometryError prefixed with the pointer of the blend, ConvergenceError, Cancelled.
[[nodiscard]] JobResult run_job(const JobSpec& job, const Progress& progress = {},
                                const RunOptions& options = {});

/// The surfaces that verify looks at, for a blend at the stage "formula" or "fitted" (or any surface read
/// back).
[[nodiscard]] BlendUnderTest under_test(const BlendResult& blend, const Surface& surface);

/// Every figure that the two measurements of it disagree about, at every stage: the program is wrong then.
[[nodiscard]] std::vector<std::string> program_defects(const JobResult& result);

}  // namespace blendwright
