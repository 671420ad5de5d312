#include "app/pipeline/mesh_job.hpp"

#include <algorithm>
#include <cmath>

#include "app/json/object_reader.hpp"
#include "app/pipeline/mesh_pictures.hpp"
#include "app/pipeline/progress_part.hpp"
#include "app/pipeline/result_facts.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/exchange/mesh_files.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;

constexpr double meshed = 0.9;  // of the progress, before anything is written

constexpr NamedRow formats[] = {
    {".vtp", "VTK PolyData: everything, with units, as 64-bit floats"},
    {".stl", "STL, binary: triangles as 32-bit floats"},
    {".obj", "Wavefront OBJ: points, normals and triangles as text"},
    {".ply", "PLY, binary: everything but the units, as 64-bit floats"},
    {".png", "a picture"},
};

constexpr NamedRow columns[] = {
    {"value", "the field"},
    {"distance_error", "(value - level) / |gradient|: how far the point is off the surface, length"},
    {"mean_curvature", "positive where the solid is convex, 1/length"},
    {"gaussian_curvature", "product of the principal curvatures, 1/length^2"},
    {"member", "index of the primitive whose surface is nearest"},
};

std::vector<std::string> names_of(std::span<const NamedRow> rows) {
  std::vector<std::string> names;
  for (const NamedRow& row : rows) names.emplace_back(row.name);
  return names;
}

bool has_row(std::span<const NamedRow> rows, const std::string& name) {
  return std::any_of(rows.begin(), rows.end(), [&](const NamedRow& r) { return r.name == name; });
}

void require_formats(const MeshJob& job) {
  for (const fs::path& file : job.outputs)
    if (!has_row(formats, lower_case_extension(file)))
      throw InputError("--output",
                       "is " + in_quotes(file.string()) + ", must end in " + listed(names_of(formats)));
  if (!job.colour.empty() && !has_row(columns, job.colour))
    throw InputError("--colour", "is " + in_quotes(job.colour) + ", must be " + listed(names_of(columns)) +
                                     suggestion(job.colour, names_of(columns)));
}

MeshOptions options_of(const SceneFile& scene, const MeshJob& job) {
  MeshOptions options;
  options.box = job.box;
  options.at_box = job.at_box;
  options.max_memory = job.max_memory;
  const std::optional<Box>& around = job.box ? job.box : scene.scene.field.bounds();
  if (!around)
    throw InputError("--box",
                     "is missing: the solid " + in_quotes(scene.spec.solid) +
                         " is unbounded, or its bounds are not known; give the box to be meshed, as in "
                         "--box=-10,-10,-10,10,10,10");
  options.cell = job.cell.value_or(around->size().maxCoeff() / static_cast<double>(job.cells));
  return options;
}

/// Problems of the mesher named as the program's flags.
InputError with_flags(const InputError& error, bool by_cells) {
  std::vector<Problem> problems = error.problems();
  for (Problem& p : problems) {
    if (p.where == "cell") p.where = by_cells ? "--cells" : "--cell";
    if (p.where == "box") p.where = "--box";
    if (p.where == "max_memory") p.where = "--max-memory";
  }
  return InputError(std::move(problems));
}

/// What the field does not know: names, units, where it came from.
void describe(TriMesh& mesh, const SceneFile& scene, const MeshOptions& options) {
  mesh.name = scene.spec.solid;
  mesh.note = "scene " + scene.name + " (" + scene.source_hash + "), solid " + scene.spec.solid + ", cell " +
              number_text(options.cell) + " " + name(scene.spec.unit);
  mesh.facts = scene_facts(scene.spec);
  mesh.shown = "mean_curvature";
  for (Column& c : mesh.columns) {
    c.unit = c.name == "distance_error" ? name(scene.spec.unit) : curvature_unit(c.name, scene.spec.unit);
    if (c.name == "member") c.labels = scene.scene.field.members();
  }
}

void write_mesh(const fs::path& file, const TriMesh& mesh) {
  const std::string extension = lower_case_extension(file);
  const std::span<const TriMesh> one(&mesh, 1);
  if (extension == ".vtp") write_vtp(file, mesh);
  if (extension == ".stl") write_stl(file, one);
  if (extension == ".obj") write_obj(file, one);
  if (extension == ".ply") write_ply(file, mesh);
}

void write_files(MeshResult& result, const SceneFile& scene, const MeshJob& job, const Progress& progress) {
  StagedFiles staged(job.outputs);
  try {
    for (std::size_t i = 0; i < job.outputs.size(); ++i) {
      const fs::path& file = job.outputs[i];
      progress.at(meshed + (1.0 - meshed) * static_cast<double>(i) / static_cast<double>(job.outputs.size()),
                  "writing " + file.filename().string());
      if (lower_case_extension(file) == ".png")
        write_mesh_picture(staged.of(file), scene, result.made.mesh, job.colour, result.notes);
      else
        write_mesh(staged.of(file), result.made.mesh);
    }
    result.files = staged.publish();
  } catch (const IoError& e) {
    throw staged.with_final_names(e);
  }
}

}  // namespace

std::span<const NamedRow> mesh_formats() { return formats; }
std::span<const NamedRow> mesh_columns() { return columns; }

MeshResult run_mesh_job(const SceneFile& scene, const MeshJob& job, const Progress& progress) {
  require_formats(job);
  if (!job.overwrite) refuse_existing(job.outputs);
  MeshResult result{options_of(scene, job), {}, {}, {}, {}};
  StopWatch watch;
  try {
    result.made = polygonize(scene.scene.field, result.options, part_of(progress, 0.0, meshed));
  } catch (const InputError& e) {
    throw with_flags(e, !job.cell);
  }
  describe(result.made.mesh, scene, result.options);
  result.times.push_back({"meshing", watch.lap()});
  if (!job.outputs.empty()) {
    write_files(result, scene, job, progress);
    result.times.push_back({"writing", watch.lap()});
  }
  return result;
}

}  // namespace blendwright
