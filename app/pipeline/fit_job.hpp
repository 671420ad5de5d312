#pragma once
// A job whose blends are fitted to what their "fit" asks for: a job that reproduces them, and what changed.
#include <string>
#include <vector>

#include "app/pipeline/fit_spec.hpp"
#include "app/pipeline/run_job.hpp"
#include "kernel/exchange/picture.hpp"

namespace blendwright {

struct FitJobOptions {
  /// Instead of the job's objectives, for every blend; the rest of a blend's "fit" stays.
  std::vector<FitObjective> objectives{};
  std::vector<std::string> files{};  ///< of `objectives`, relative to the current folder
  std::optional<int> starts{};
  int threads = 1;
  std::filesystem::path folder{};  ///< where the fitted job will lie: its files are named from there
};

struct FittedBlend {
  std::string name;
  BlendEntry before, after;
  FitSpec asked;
  ShapeFitResult fit;
  std::vector<std::string> warnings;  ///< those of the fit, and trimlines that are nearer than a clearance
  [[nodiscard]] bool fulfilled() const;
};

struct FitJobResult {
  std::string text;  ///< of the fitted job
  std::vector<FittedBlend> blends;
  JobResult verified;  ///< of the fitted job's text, read again
  std::vector<StageTime> times;
  [[nodiscard]] bool fulfilled() const;
};

/// `text`: that of `job`. Blends without "fit" stay as they are. Throws InputError with JSON pointers,
/// IoError
/// ("/blends/x/fit/objectives/0/file: ..."), GeometryError, ConvergenceError, Cancelled.
[[nodiscard]] FitJobResult run_fit_job(const std::string& text, const JobSpec& job,
                                       const FitJobOptions& options, const Progress& progress = {});

/// The convergence of every blend as a plot.
[[nodiscard]] Plot convergence_plot(const FitJobResult& result);

}  // namespace blendwright
