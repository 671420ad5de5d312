#include <cmath>

#include "app/cli/fit_scene.hpp"
#include "app/cli/run_table.hpp"
#include "app/cli/text_table.hpp"
#include "app/pipeline/fit_scene_job.hpp"
#include "app/pipeline/staging.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/text_file.hpp"

namespace blendwright {
namespace {

void refuse_what_is_for_jobs(const FitCommand& command) {
  std::vector<Problem> problems;
  const auto refuse = [&](const char* flag, bool given) {
    if (given) problems.push_back({flag, "is for blends; a scene is fitted to --points"});
  };
  refuse("--objective", !command.objectives.empty());
  refuse("--starts", command.starts.has_value());
  refuse("--plot", !command.plot.empty());
  refuse("--report", !command.report.empty());
  if (!problems.empty()) throw InputError(std::move(problems));
}

std::string table_of(const SceneFitOutcome& outcome) {
  const SceneFitResult& fit = outcome.fit;
  const std::string unit = name(outcome.before.spec.unit);
  TextRows rows{{"number", "before", "after", "deviation", ""}};
  for (const FittedNumber& n : fit.numbers)
    rows.push_back({n.name, number_text(n.start, 6), number_text(n.value, 6),
                    std::isfinite(n.deviation) ? number_text(n.deviation, 2) : "-",
                    n.at_bound     ? "at bound"
                    : n.determined ? ""
                                   : "NOT DETERMINED"});
  return aligned(rows) + "  distance of " + counted(fit.points, "point") + ": rms " +
         number_text(fit.rms, 3) + " " + unit + " (before " + number_text(fit.rms_before, 3) + "), worst " +
         number_text(fit.worst, 3) + " at " + number_text(fit.worst_point.x(), 4) + "," +
         number_text(fit.worst_point.y(), 4) + "," + number_text(fit.worst_point.z(), 4) + "; " +
         std::to_string(fit.inliers) + " within three deviations\n";
}

std::vector<WrittenFile> written(const FitCommand& command, const SceneFitOutcome& outcome) {
  if (command.output.empty() || command.output == "-") return {};
  StagedFiles staged({command.output});
  try {
    write_text_file(staged.of(command.output), outcome.text);
    return staged.publish();
  } catch (const IoError& e) {
    throw staged.with_final_names(e);
  }
}

}  // namespace

int fit_scene_file(const FitCommand& command, const std::string& text, const Console& console, Run& run) {
  refuse_what_is_for_jobs(command);
  SceneFitJob job{command.points, command.unknowns, {}};
  job.options.robust_scale = command.robust_scale;
  job.options.start_from_points = command.from_points;
  const SceneFitOutcome outcome = run_scene_fit(text, command.job, job, run.progress());
  const std::vector<WrittenFile> files = written(command, outcome);
  run.clear();
  if (!command.quiet) {
    for (const std::string& w : outcome.fit.warnings) console.warn(w);
    for (const std::string& w : outcome.fit.not_unique) console.warn(w);
  }
  if (command.output == "-") {
    console.out() << outcome.text;
  } else if (command.json) {
    console.out() << scene_fit_json(outcome);
  } else if (!command.quiet) {
    console.out() << shown_name(command.job) << ": " << counted(outcome.fit.numbers.size(), "number")
                  << " fitted to " << command.points << '\n'
                  << table_of(outcome)
                  << with_seconds(
                         files.empty()
                             ? std::string("nothing written")
                             : written_files(files, [](const WrittenFile& f) { return size_text(f.bytes); }),
                         run.seconds());
  }
  return outcome.fit.converged && outcome.fit.not_unique.empty() ? exit_done : exit_not_verified;
}

}  // namespace blendwright
