#include "app/cli/arguments.hpp"
#include "app/cli/mesh_table.hpp"
#include "app/cli/run_table.hpp"
#include "app/cli/text_table.hpp"
#include "app/cli/verbs.hpp"
#include "app/json/json_value.hpp"
#include "app/json/object_reader.hpp"
#include "app/pipeline/picture_job.hpp"
#include "kernel/base/parallel_for.hpp"

namespace blendwright {
namespace {

void choose_show(const PictureCommand& command, PictureJob& job) {
  if (command.show.empty()) {
    job.automatic = true;
  } else if (command.show == "trimlines") {
    job.trimlines = true;
  } else if (const auto show = show_named(command.show)) {
    job.show = *show;
  } else {
    const std::vector<std::string> words = picture_words();
    throw InputError("--show", "is " + in_quotes(command.show) + ", must be " + listed(words) +
                                   suggestion(command.show, words));
  }
}

PictureJob picture_job_of(const PictureCommand& command) {
  PictureJob job;
  job.input = command.input;
  job.to = command.to;
  choose_show(command, job);
  job.options.curvature = curvature_named(command.curvature).value_or(CurvatureFigure::mean);
  job.options.logarithmic = command.log;
  job.options.stripes = command.stripes;
  if (!command.pull.empty()) job.options.pull = direction_argument(command.pull);
  if (!command.light.empty()) job.to_light = direction_argument(command.light);
  if (!command.from.empty()) job.from = direction_argument(command.from);
  if (!command.plane.empty()) {
    const auto [axis, at] = plane_argument(command.plane);
    job.plane = SectionPlane{axis, at};
  }
  if (!command.range.empty()) job.range = range_argument(command.range);
  if (!command.box.empty()) job.reading.box = box_argument(command.box);
  job.reading.solid = command.solid;
  job.reading.cells = static_cast<std::size_t>(command.cells);
  job.views = command.views;
  job.comb_lines = static_cast<std::size_t>(command.comb_lines);
  job.output = command.output;
  const auto [width, height] = size_argument(command.size);
  job.width = width;
  job.height = height;
  job.dark = command.background == "dark";
  job.overwrite = command.force;
  return job;
}

}  // namespace

std::vector<std::string> picture_words() {
  std::vector<std::string> words;
  for (const ShowRow& row : show_table()) words.emplace_back(row.name);
  words.emplace_back("trimlines");
  return words;
}

int picture(const PictureCommand& command, const Console& console) {
  return guarded(console, shown_name(command.input), [&] {
    Run run(console, command.quiet);
    std::optional<ThreadLimit> limit;
    if (command.threads) limit.emplace(*command.threads);
    const PictureResult result = run_picture_job(picture_job_of(command), run.progress());
    run.clear();
    if (!command.quiet)
      for (const std::string& n : result.plan.notes) console.warn(n);
    if (command.json) {
      console.out() << picture_report_json(result, command.times);
    } else if (!command.quiet) {
      console.out() << result.plan.title() << '\n' << with_seconds(written_text(result.files), run.seconds());
    }
    return exit_done;
  });
}

}  // namespace blendwright
