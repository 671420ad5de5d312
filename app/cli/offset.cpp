#include <cmath>

#include "app/cli/arguments.hpp"
#include "app/cli/mesh_table.hpp"
#include "app/cli/relation_text.hpp"
#include "app/cli/run_table.hpp"
#include "app/cli/text_table.hpp"
#include "app/cli/verbs.hpp"
#include "app/pipeline/offset_job.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"

namespace blendwright {
namespace {

OffsetRequest request_of(const OffsetCommand& command) {
  using Kind = OffsetRequest::Kind;
  OffsetRequest request{.tolerance = command.tolerance};
  if (command.round) {
    request.kind = Kind::round;
    request.radius = *command.round;
  } else if (command.fillet) {
    request.kind = Kind::fillet;
    request.radius = *command.fillet;
  } else if (!command.shell.empty()) {
    request.kind = Kind::shell;
    const auto [inner, outer] = shell_argument(command.shell);
    request.inner = inner;
    request.outer = outer;
  } else if (command.distance) {
    request.kind = command.kind == "iso" ? Kind::iso : command.kind == "normal" ? Kind::normal : Kind::ball;
    request.distance = *command.distance;
  } else {
    throw InputError("--distance", "is missing; --distance, --shell, --round or --fillet must be given");
  }
  if (command.tolerance && (request.kind == Kind::iso || request.kind == Kind::normal))
    throw InputError("--tolerance", "is given with --kind " + command.kind + ", must go with a ball");
  return request;
}

std::string signed_text(double x) { return std::abs(x) < 1e-18 ? "0" : scientific_text(x); }

TextRows check_rows(const OffsetCheck& c, const std::string& unit) {
  const OffsetError& e = c.error;
  if (e.samples == e.without_root)
    return {{c.of + " error", "none found: no offset surface near " + counted(e.samples, "point")}};
  TextRows rows{{c.of + " error", signed_text(e.worst) + " " + unit + " at worst, " + signed_text(e.rms) +
                                      " rms, over " + counted(e.samples - e.without_root, "point")},
                {"", "worst at " + shown_point(e.where)}};
  if (e.without_root > 0)
    rows.push_back({"", "none near " + counted(e.without_root, "other point") + ", as where it is trimmed"});
  return rows;
}

std::string offset_table(const OffsetResult& result) {
  TextRows rows = mesh_rows(result.scene, result.mesh);
  for (const OffsetCheck& c : result.checks)
    for (auto& row : check_rows(c, name(result.scene.spec.unit))) rows.push_back(std::move(row));
  return aligned(rows);
}

}  // namespace

int offset(const OffsetCommand& command, const Console& console) {
  const MeshCommand& meshing = command.mesh;
  return guarded(console, shown_name(meshing.scene), [&] {
    Run run(console, meshing.quiet);
    std::optional<ThreadLimit> limit;
    if (meshing.threads) limit.emplace(*meshing.threads);
    const OffsetRequest request = request_of(command);
    const SceneFile original = build_scene_file(meshing.scene, meshing.solid);
    const OffsetResult result = run_offset_job(original, request, mesh_job_of(meshing), run.progress());
    run.clear();
    if (!meshing.quiet) {
      warn_of_mesh(console, result.scene, result.mesh);
      for (const std::string& n : result.notes) console.err() << n << '\n';
    }
    if (meshing.json) {
      console.out() << offset_report_json(request, result, meshing.times);
    } else if (!meshing.quiet) {
      console.out() << shown_name(meshing.scene) << ": " << result.scene.spec.solid << ", "
                    << counted(result.scene.scene.nodes, "node") << '\n'
                    << offset_table(result) << with_seconds(written_text(result.mesh.files), run.seconds());
    }
    return exit_done;
  });
}

}  // namespace blendwright
