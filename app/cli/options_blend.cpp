#include "app/cli/arguments.hpp"
#include "app/cli/options.hpp"
#include "app/json/choices.hpp"

namespace blendwright {
namespace {

void add_certify(CLI::App* sub, bool& certify) {
  sub->add_flag(
      "--certify", certify,
      "prove bounds of gap, angle and curvature jump between the samples; what is not proven fails");
}

void add_fairness(CLI::App* sub, bool& fairness, std::string& pull) {
  CLI::Option* flag = sub->add_flag("--fairness", fairness, "energies, extremes and turns of the curvature");
  sub->add_option("--pull", pull, "direction x,y,z that a mould opens in: the draft angles along it")
      ->needs(flag)
      ->check(readable(direction_argument, "X,Y,Z"));
}

}  // namespace

void add_blend(CLI::App& app, Program& program) {
  const auto command = std::make_shared<BlendCommand>();
  command->called = program.called;
  std::vector<std::string> formats;
  for (const auto& c : format_choices()) formats.emplace_back(c.name);
  CLI::App* sub = verb(app, "blend");
  sub->add_option("JOB", command->job, "job file; - reads standard input")->required();
  sub->add_option("-o,--out,--output", command->folder, "output folder")
      ->capture_default_str()
      ->check(CLI::Validator(
          [](std::string& text) {
            return text.empty() ? std::string("is empty, must be a folder; . is the current one") : "";
          },
          "FOLDER"));
  sub->add_option("--format", command->formats, "formats instead of the job's, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(formats));
  sub->add_flag("--force", command->force, "replace files that exist");
  add_certify(sub, command->certify);
  add_fairness(sub, command->fairness, command->pull);
  add_report(sub, command->report);
  add_json(sub, command->json, command->times);
  sub->add_flag("--quiet", command->quiet, "no table, no warnings, no progress");
  add_threads(sub, command->threads);
  sub->callback([command, &program] { program.code = blend(*command, program.console); });
}

void add_verify(CLI::App& app, Program& program) {
  const auto command = std::make_shared<VerifyCommand>();
  command->called = program.called;
  CLI::App* sub = verb(app, "verify");
  sub->add_option("JOB", command->job, "job file; - reads standard input")->required();
  optional_number(sub, "--tol-position", command->position, "largest gap, model units", positive());
  optional_number(sub, "--tol-angle-deg", command->angle_deg, "largest angle between tangent planes",
                  positive());
  optional_number(sub, "--tol-curvature", command->curvature,
                  "largest jump of normal curvature, 1/model unit", positive());
  add_certify(sub, command->certify);
  add_fairness(sub, command->fairness, command->pull);
  add_report(sub, command->report);
  sub->add_flag("--force", command->force, "replace a report that exists");
  add_json(sub, command->json, command->times);
  sub->add_flag("--quiet", command->quiet, "no table, no warnings, no progress");
  add_threads(sub, command->threads);
  sub->callback([command, &program] { program.code = verify(*command, program.console); });
}

}  // namespace blendwright
