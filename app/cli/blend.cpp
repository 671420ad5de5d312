#include <algorithm>

#include "app/cli/arguments.hpp"
#include "app/cli/run_table.hpp"
#include "app/cli/verbs.hpp"
#include "app/json/choices.hpp"
#include "app/json/job_reader.hpp"
#include "app/report/report_file.hpp"
#include "kernel/base/parallel_for.hpp"

namespace blendwright {
namespace {

std::vector<OutputFormat> formats_named(const std::vector<std::string>& names) {
  std::vector<OutputFormat> formats;
  for (const Choice<OutputFormat>& c : format_choices())
    if (std::find(names.begin(), names.end(), c.name) != names.end()) formats.push_back(c.value);
  return formats;
}

}  // namespace

int blend(const BlendCommand& command, const Console& console) {
  return guarded(console, shown_name(command.job), [&] {
    Run run(console, command.quiet);
    std::optional<ThreadLimit> limit;
    if (command.threads) limit.emplace(*command.threads);
    JobSpec job = read_job_file(command.job);
    if (!command.formats.empty()) job.output.formats = formats_named(command.formats);
    if (!command.report.empty()) require_report_place(command.report, command.force);
    JobResult result =
        run_job(job, run.progress(),
                {.certify = command.certify, .fairness = fairness_of(command.fairness, command.pull)});
    JobOutputs outputs =
        write_outputs(result, {.folder = command.folder, .overwrite = command.force, .times = command.times},
                      run.progress());
    if (!command.report.empty())
      write_blend_report(command.report, result, &outputs, command.called, outputs.notes);
    run.clear();
    if (!command.quiet) {
      for (const std::string& w : result.warnings) console.warn(w);
      for (const std::string& n : outputs.notes) console.err() << n << '\n';
    }
    if (command.json) {
      console.out() << report_json(result, &outputs, command.times);
    } else if (!command.quiet) {
      console.out() << run_table(result, &outputs, shown_name(command.job))
                    << with_seconds(written_files(outputs, job.output.step_schema), run.seconds());
    }
    return exit_code_of(result, &outputs);
  });
}

}  // namespace blendwright
