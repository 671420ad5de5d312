#include "app/cli/verbs.hpp"
#include "app/json/fit_report.hpp"
#include "app/json/job_reader.hpp"
#include "app/json/scene_reader.hpp"

namespace blendwright {

int schema(const SchemaCommand& command, const Console& console) {
  return guarded(console, "schema", [&] {
    console.out() << (command.of == "report"       ? report_schema()
                      : command.of == "fit-report" ? fit_report_schema()
                      : command.of == "scene"      ? scene_schema()
                                                   : job_schema());
    return exit_done;
  });
}

}  // namespace blendwright
