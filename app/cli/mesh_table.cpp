#include "app/cli/mesh_table.hpp"

#include "app/cli/arguments.hpp"
#include "app/cli/run_table.hpp"
#include "app/cli/text_table.hpp"
#include "app/cli/verbs.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

std::string cells_text(const MeshFacts& f) {
  return std::to_string(f.cells[0]) + " x " + std::to_string(f.cells[1]) + " x " + std::to_string(f.cells[2]);
}

/// What is far below rounding is 0.
std::string distance_text(double x) { return x < 1e-18 ? "0" : scientific_text(x); }

}  // namespace

MeshJob mesh_job_of(const MeshCommand& command) {
  MeshJob job;
  job.cell = command.cell;
  job.cells = static_cast<std::size_t>(command.cells);
  if (!command.box.empty()) job.box = box_argument(command.box);
  job.at_box = command.at_box == "open" ? MeshOptions::AtBox::open : MeshOptions::AtBox::cap;
  job.max_memory = memory_argument(command.max_memory);
  job.outputs.assign(command.outputs.begin(), command.outputs.end());
  job.overwrite = command.force;
  job.colour = command.colour;
  return job;
}

TextRows mesh_rows(const SceneFile& scene, const MeshResult& result) {
  const MeshFacts& f = result.made.facts;
  const std::string unit = name(scene.spec.unit);
  const bool open = f.cut_by_box && result.options.at_box == MeshOptions::AtBox::open;
  TextRows rows{{"cells", cells_text(f) + ", each " + number_text(result.options.cell, 6) + " " + unit},
                {"live blocks", std::to_string(f.live_blocks) + " of 8 x 8 x 8 cells"},
                {"points evaluated", std::to_string(f.evaluated_points)},
                {"vertices", std::to_string(f.vertices)},
                {"triangles", std::to_string(f.triangles)},
                {"area", number_text(f.area, 9) + " " + unit + "^2"},
                {"volume", open ? "none: the mesh is open" : number_text(f.volume, 9) + " " + unit + "^3"},
                {"Euler characteristic", std::to_string(f.euler_characteristic)},
                {"components", std::to_string(f.components)},
                {"distance error", distance_text(f.largest_distance) + " " + unit + " at most, " +
                                       distance_text(f.mean_distance) + " on average"}};
  if (f.without_normal > 0)
    rows.push_back({"without normal", counted(f.without_normal, "vertex") + ": the gradient vanishes there"});
  return rows;
}

std::string solid_name(const SceneFile& scene) {
  return scene.spec.solid.front() == '/' ? "" : "the solid \"" + scene.spec.solid + "\", ";
}

std::string written_text(const std::vector<WrittenFile>& files) {
  if (files.empty()) return "nothing written";
  return written_files(files, [](const WrittenFile& f) { return size_text(f.bytes); });
}

void warn_of_mesh(const Console& console, const SceneFile& scene, const MeshResult& result) {
  for (const Problem& w : scene.scene.warnings) console.warn(w.where + ": " + w.message);
  if (result.made.facts.cut_by_box)
    console.warn(result.options.at_box == MeshOptions::AtBox::cap
                     ? "the box cuts the solid; it is closed there by flat faces"
                     : "the box cuts the solid; it is left open there");
  for (const std::string& n : result.notes) console.err() << n << '\n';
}

}  // namespace blendwright
