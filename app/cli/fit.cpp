#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>

#include "app/cli/fit_scene.hpp"
#include "app/cli/run_table.hpp"
#include "app/cli/text_table.hpp"
#include "app/cli/verbs.hpp"
#include "app/json/fit_reader.hpp"
#include "app/json/fit_report.hpp"
#include "app/json/job_reader.hpp"
#include "app/report/report_file.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/base/text_file.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "kernel/exchange/svg_plot.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;

bool to_standard_output(const FitCommand& command) { return command.output == "-"; }

/// What can be said before anything is read.
void require_sensible(const FitCommand& command) {
  std::vector<Problem> problems;
  const auto ending = [&](const char* flag, const std::string& file, const char* words, bool good) {
    if (!file.empty() && !good)
      problems.push_back({flag, "is " + in_quotes(file) + ", must end in " + words});
  };
  const std::string plot = lower_case_extension(command.plot);
  ending("--output", command.output, ".json",
         to_standard_output(command) || lower_case_extension(command.output) == ".json");
  ending("--plot", command.plot, ".png or .svg", plot == ".png" || plot == ".svg");
  if (to_standard_output(command) && command.json)
    problems.push_back({"--json", "and --output - both take standard output; give the fitted job a file"});
  if (!problems.empty()) throw InputError(std::move(problems));
  if (!command.report.empty()) require_report_place(command.report, command.force);
  std::vector<fs::path> files;
  for (const std::string& file : {command.output, command.plot})
    if (!file.empty() && file != "-") files.emplace_back(file);
  std::error_code error;
  if (command.job != "-" && !command.output.empty() && fs::equivalent(command.job, command.output, error) &&
      !command.force)
    throw IoError(command.output + ": is the job itself; --force replaces it");
  if (!command.force) refuse_existing(files);
}

FitJobOptions options_of(const FitCommand& command, const JobSpec& job) {
  FitJobOptions options;
  for (const std::string& text : command.objectives) {
    const TypedObjective typed = typed_objective(text, "--objective");
    options.objectives.push_back(typed.objective);
    options.files.push_back(typed.file);
  }
  options.starts = command.starts;
  options.threads =
      command.threads.value_or(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  options.folder = command.output.empty() || to_standard_output(command)
                       ? job.folder
                       : fs::path(command.output).parent_path();
  return options;
}

std::string figure(double x) { return std::isfinite(x) ? number_text(x, 5) : "-"; }

std::string with_unit(const ObjectiveChange& o) {
  return o.unit.empty() ? o.measure : std::string(o.measure).append(" (").append(o.unit).append(")");
}

std::string table_of(const FittedBlend& blend) {
  TextRows wanted{{"objective", "weight", "measure", "before", "after", "target"}};
  for (const ObjectiveChange& o : blend.fit.objectives)
    wanted.push_back({o.name, number_text(o.weight, 4), with_unit(o), figure(o.before), figure(o.after),
                      o.fulfilled ? "met" : "NOT MET"});
  TextRows changed{{"parameter", "before", "after", "deviation", ""}};
  for (const FittedParameter& p : blend.fit.parameters)
    changed.push_back({p.name, figure(p.start), figure(p.value),
                       std::isfinite(p.deviation) ? scientific_text(p.deviation) : "not determined",
                       p.at_bound ? "at its bound" : ""});
  const std::size_t steps = blend.fit.costs.empty() ? 0 : blend.fit.costs.size() - 1;
  return aligned(wanted) + aligned(changed) + "  " + counted(steps, "iteration") +
         (blend.fit.converged ? "" : ", not converged") + ", condition " +
         (std::isfinite(blend.fit.condition) ? scientific_text(blend.fit.condition) : "infinite") + "\n";
}

std::string answer_text(const FitJobResult& result, const std::string& job, bool sound) {
  std::string text = job + ": " + counted(result.blends.size(), "blend") + " fitted, " +
                     (result.fulfilled() ? "all targets met" : "not all targets met") +
                     (sound ? ", joints verified\n" : ", joints NOT verified\n");
  for (const FittedBlend& blend : result.blends) {
    if (result.blends.size() > 1) text += blend.name + "\n";
    text += table_of(blend);
  }
  return text;
}

void warn_of(const FitJobResult& result, const Console& console) {
  for (const FittedBlend& blend : result.blends) {
    const std::string where = "/blends/" + blend.name + ": ";
    for (const std::string& s : blend.fit.not_unique) console.warn(where + "not unique: " + s);
    for (const std::string& w : blend.warnings) console.warn(w.rfind("/blends/", 0) == 0 ? w : where + w);
  }
  for (const std::string& w : result.verified.warnings) console.warn(w);
}

void write_plot(const fs::path& file, const FitJobResult& result, std::vector<std::string>& notes) {
  const Plot plot = convergence_plot(result);
  if (lower_case_extension(file) == ".svg") return write_text_file(file, svg_plot(plot, "convergence"));
  const Display display;
  if (display.available())
    write_plots(file, std::vector<Plot>{plot}, display, 760, 460);
  else
    notes.push_back("no convergence plot: " + display.reason() + "; .svg needs no display");
}

/// The fitted job and the plot appear together.
std::vector<WrittenFile> write_files(const FitCommand& command, const FitJobResult& result,
                                     std::vector<std::string>& notes) {
  std::vector<fs::path> files;
  if (!command.output.empty() && !to_standard_output(command)) files.emplace_back(command.output);
  if (!command.plot.empty()) files.emplace_back(command.plot);
  if (files.empty()) return {};
  StagedFiles staged(files);
  try {
    if (!command.output.empty() && !to_standard_output(command))
      write_text_file(staged.of(command.output), result.text);
    if (!command.plot.empty()) write_plot(staged.of(command.plot), result, notes);
    std::vector<WrittenFile> written = staged.publish();
    for (WrittenFile& f : written) f.kind = lower_case_extension(f.path) == ".json" ? "job" : "plot";
    return written;
  } catch (const IoError& e) {
    throw staged.with_final_names(e);
  }
}

/// A scene of soft objects has nodes, a job has blends.
bool is_scene(const std::string& text) {
  const JsonValue root = parse_json(text, R"(the shortest job has "primaries" and "blends")");
  return root.find("nodes") && !root.find("blends");
}

void refuse_what_is_for_scenes(const FitCommand& command) {
  std::vector<Problem> problems;
  const auto refuse = [&](const char* flag, bool given) {
    if (given) problems.push_back({flag, "is for scenes; a job is fitted to its \"fit\" and --objective"});
  };
  refuse("--points", !command.points.empty());
  refuse("--unknown", !command.unknowns.empty());
  refuse("--robust-scale", command.robust_scale.has_value());
  refuse("--from-points", command.from_points);
  if (!problems.empty()) throw InputError(std::move(problems));
}

int fit_job(const FitCommand& command, const std::string& text, const Console& console, Run& run) {
  const JobSpec job = read_job(text, command.job);
  const FitJobOptions options = options_of(command, job);
  const FitJobResult result = run_fit_job(text, job, options, run.progress());
  std::vector<std::string> notes;
  std::vector<WrittenFile> files = write_files(command, result, notes);
  if (!command.report.empty()) {
    write_fit_report(command.report, job, result, files, command.called, notes);
    files.push_back({command.report, "report", std::filesystem::file_size(command.report)});
  }
  run.clear();
  const bool sound = verified(result.verified);
  if (!command.quiet) {
    for (const std::string& n : notes) console.err() << n << '\n';
    warn_of(result, console);
  }
  if (to_standard_output(command))
    console.out() << result.text;
  else if (command.json)
    console.out() << fit_report_json(job, result, files, command.times);
  else if (!command.quiet)
    console.out() << answer_text(result, shown_name(command.job), sound)
                  << with_seconds(
                         files.empty()
                             ? std::string("nothing written")
                             : written_files(files, [](const WrittenFile& f) { return size_text(f.bytes); }),
                         run.seconds());
  const std::vector<std::string> defects = program_defects(result.verified);
  for (const std::string& d : defects) console.fail(d);
  if (!defects.empty()) return exit_defect;
  return result.fulfilled() && sound ? exit_done : exit_not_verified;
}

}  // namespace

int fit(const FitCommand& command, const Console& console) {
  return guarded(console, shown_name(command.job), [&] {
    Run run(console, command.quiet);
    std::optional<ThreadLimit> limit;
    if (command.threads) limit.emplace(*command.threads);
    require_sensible(command);
    const std::string text = read_json_text(command.job);
    if (is_scene(text)) return fit_scene_file(command, text, console, run);
    refuse_what_is_for_scenes(command);
    return fit_job(command, text, console, run);
  });
}

}  // namespace blendwright
