#include "app/cli/mesh_table.hpp"
#include "app/cli/run_table.hpp"
#include "app/cli/text_table.hpp"
#include "app/cli/verbs.hpp"
#include "app/report/report_file.hpp"
#include "kernel/base/parallel_for.hpp"

namespace blendwright {

int mesh(const MeshCommand& command, const Console& console) {
  return guarded(console, shown_name(command.scene), [&] {
    Run run(console, command.quiet);
    std::optional<ThreadLimit> limit;
    if (command.threads) limit.emplace(*command.threads);
    const SceneFile scene = build_scene_file(command.scene, command.solid);
    if (!command.report.empty()) require_report_place(command.report, command.force);
    MeshResult result = run_mesh_job(scene, mesh_job_of(command), run.progress());
    if (!command.report.empty())
      write_mesh_report(command.report, scene, result, command.called, result.notes);
    run.clear();
    if (!command.quiet) warn_of_mesh(console, scene, result);
    if (command.json) {
      console.out() << mesh_report_json(scene, result, command.times);
    } else if (!command.quiet) {
      console.out() << shown_name(command.scene) << ": " << solid_name(scene)
                    << counted(scene.scene.nodes, "node") << '\n'
                    << aligned(mesh_rows(scene, result))
                    << with_seconds(written_text(result.files), run.seconds());
    }
    return exit_done;
  });
}

}  // namespace blendwright
