#include "app/pipeline/picture_job.hpp"

#include <algorithm>

#include "app/json/json_value.hpp"
#include "app/pipeline/picture_plan.hpp"
#include "app/pipeline/progress_part.hpp"
#include "app/pipeline/trimline_plots.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/exchange/mesh_files.hpp"

namespace blendwright {
namespace {

constexpr double planned = 0.85;  // of the progress
constexpr int least_size = 64, most_size = 4096;

void require_output(const PictureJob& job) {
  std::vector<Problem> problems;
  if (lower_case_extension(job.output) != ".png")
    problems.push_back({"--output", "is " + in_quotes(job.output.string()) + ", must end in .png"});
  for (const int pixels : {job.width, job.height})
    if (pixels < least_size || pixels > most_size) {
      problems.push_back({"--size", "is " + std::to_string(job.width) + "x" + std::to_string(job.height) +
                                        ", must be from " + std::to_string(least_size) + " to " +
                                        std::to_string(most_size) + " pixels each way"});
      break;
    }
  if (!problems.empty()) throw InputError(std::move(problems));
}

PicturePlan plan_of_trimlines(const PictureInput& input, const PictureJob& job) {
  PlotSheet sheet;
  sheet.plots = trimline_plots(input);
  if (sheet.plots.empty())
    throw InputError("--show", "is \"trimlines\", which " + input.name +
                                   " does not have; must be a job, or a .vtp of trimlines that \"blendwright "
                                   "blend\" wrote");
  PicturePlan plan;
  const WorstFigures worst = worst_of(input);
  sheet.title = input.name;
  if (worst.known) sheet.title += ": " + worst.text(input);
  sheet.width = job.width;
  sheet.height = job.height;
  sheet.dark = job.dark;
  sheet.columns = 3;
  if (sheet.plots.size() == 6 && job.height > job.width) sheet.columns = 2;
  if (sheet.plots.size() == 3 && job.width < 2 * job.height) sheet.columns = 2;
  if (worst.known) plan.figure = PictureFigure{"gap", input.unit ? name(*input.unit) : "", 0.0, worst.gap};
  plan.plots = std::move(sheet);
  return plan;
}

/// What a picture does not need is not made.
PictureInputOptions reading_of(const PictureJob& job) {
  PictureInputOptions options = job.reading;
  options.surfaces = !job.trimlines && job.show != Show::field;
  return options;
}

}  // namespace

PicturePlan plan_picture(PictureInput input, const PictureJob& given, const Progress& progress) {
  PictureJob job = given;
  if (job.automatic) {
    const bool blends = std::any_of(input.parts.begin(), input.parts.end(),
                                    [](const PicturePart& p) { return p.role == PicturePart::Role::blend; });
    job.show = blends ? Show::gap : Show::plain;
  }
  if (job.trimlines) return plan_of_trimlines(input, job);
  if (job.show == Show::field) return plan_of_field(input, job, progress);
  return plan_of_surface(std::move(input), job, progress);
}

PicturePlan plan_picture(const PictureJob& job, const Progress& progress) {
  if (!job.trimlines && job.show == Show::deviation && job.to.empty())
    throw InputError("--to", "is missing: --show deviation measures the distance to another input");
  if (!job.to.empty() && (job.trimlines || job.show != Show::deviation))
    throw InputError("--to", "is " + in_quotes(job.to) + ", but only --show deviation has another input");
  return plan_picture(read_picture_input(job.input, reading_of(job), part_of(progress, 0.0, 0.7)), job,
                      part_of(progress, 0.7, 1.0));
}

PictureResult run_picture_job(const PictureJob& job, const Progress& progress) {
  require_output(job);
  if (!job.overwrite) refuse_existing({job.output});
  StopWatch watch;
  PictureResult result;
  result.plan = plan_picture(job, part_of(progress, 0.0, planned));
  result.times.push_back({"planning", watch.lap()});
  progress.at(planned, "drawing " + job.output.filename().string());
  const Display display;
  result.times.push_back({"display", watch.lap()});
  StagedFiles staged({job.output});
  try {
    if (result.plan.picture)
      write_picture(staged.of(job.output), *result.plan.picture, display);
    else
      write_plots(staged.of(job.output), *result.plan.plots, display);
    result.files = staged.publish();
  } catch (const IoError& e) {
    throw staged.with_final_names(e);
  }
  result.times.push_back({"drawing", watch.lap()});
  return result;
}

std::string picture_report_json(const PictureResult& result, bool times) {
  JsonValue report = JsonValue::object({{"title", result.plan.title()}});
  if (result.plan.figure) {
    const PictureFigure& f = *result.plan.figure;
    report.add("figure",
               JsonValue::object({{"name", f.name}, {"unit", f.unit}, {"least", f.least}, {"most", f.most}}));
  }
  JsonValue::Array notes, files;
  for (const std::string& n : result.plan.notes) notes.emplace_back(n);
  for (const WrittenFile& f : result.files)
    files.push_back(JsonValue::object({{"path", f.path.string()}, {"kind", f.kind}, {"bytes", f.bytes}}));
  report.add("notes", std::move(notes));
  report.add("files", std::move(files));
  if (times) {
    JsonValue stages = JsonValue::object({});
    for (const StageTime& t : result.times) stages.add(t.stage, t.seconds);
    report.add("seconds", std::move(stages));
  }
  return json_text(report);
}

}  // namespace blendwright
