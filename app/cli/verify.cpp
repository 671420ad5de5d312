#include "app/cli/arguments.hpp"
#include "app/cli/run_table.hpp"
#include "app/cli/verbs.hpp"
#include "app/json/job_reader.hpp"
#include "app/report/report_file.hpp"
#include "kernel/base/parallel_for.hpp"

namespace blendwright {

int verify(const VerifyCommand& command, const Console& console) {
  return guarded(console, shown_name(command.job), [&] {
    Run run(console, command.quiet);
    std::optional<ThreadLimit> limit;
    if (command.threads) limit.emplace(*command.threads);
    JobSpec job = read_job_file(command.job);
    if (command.position) job.tolerance.position = *command.position;
    if (command.angle_deg) job.tolerance.angle = degrees(*command.angle_deg);
    if (command.curvature) job.tolerance.curvature = *command.curvature;
    if (!command.report.empty()) require_report_place(command.report, command.force);
    const JobResult result =
        run_job(job, run.progress(),
                {.certify = command.certify, .fairness = fairness_of(command.fairness, command.pull)});
    std::vector<std::string> notes;
    if (!command.report.empty()) write_blend_report(command.report, result, nullptr, command.called, notes);
    run.clear();
    for (const std::string& n : notes) console.err() << n << '\n';
    if (!command.quiet)
      for (const std::string& w : result.warnings) console.warn(w);
    if (command.json)
      console.out() << report_json(result, nullptr, command.times);
    else if (!command.quiet)
      console.out() << run_table(result, nullptr, shown_name(command.job));
    return exit_code_of(result, nullptr);
  });
}

}  // namespace blendwright
