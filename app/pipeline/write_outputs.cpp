#include "app/pipeline/write_outputs.hpp"

#include <algorithm>
#include <chrono>

#include "app/json/job_reader.hpp"
#include "app/pipeline/result_meshes.hpp"
#include "app/pipeline/result_pictures.hpp"
#include "kernel/base/text_file.hpp"
#include "kernel/brep/shape_mesh.hpp"
#include "kernel/exchange/mesh_files.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;

bool wants(const JobResult& result, OutputFormat format) {
  const auto& formats = result.job.output.formats;
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

/// The names of everything that will be written, so that nothing is overwritten by surprise.
struct Plan {
  fs::path step, picture, plots, stl, obj, report;
  std::vector<fs::path> blend_meshes, primary_meshes, trimlines;
  [[nodiscard]] std::vector<fs::path> all() const {
    std::vector<fs::path> files{step, picture, plots, stl, obj, report};
    for (const auto* list : {&blend_meshes, &primary_meshes, &trimlines})
      files.insert(files.end(), list->begin(), list->end());
    std::erase(files, fs::path());
    return files;
  }
};

Plan plan_files(const JobResult& result, const Assembly& assembly, const fs::path& folder) {
  const std::string stem = result.job.name;
  Plan plan;
  plan.report = folder / (stem + ".report.json");
  if (wants(result, OutputFormat::step)) plan.step = folder / (stem + ".step");
  if (wants(result, OutputFormat::png)) {
    plan.picture = folder / (stem + ".png");
    plan.plots = folder / (stem + ".errors.png");
  }
  if (wants(result, OutputFormat::stl)) plan.stl = folder / (stem + ".stl");
  if (wants(result, OutputFormat::obj)) plan.obj = folder / (stem + ".obj");
  if (wants(result, OutputFormat::vtp)) {
    for (const BlendPatch& b : assembly.blends) {
      plan.blend_meshes.push_back(folder / (stem + "." + b.name + ".vtp"));
      plan.trimlines.push_back(folder / (stem + "." + b.name + ".trimlines.vtp"));
    }
    for (const PrimaryPatch& p : assembly.primaries)
      plan.primary_meshes.push_back(folder / (stem + "." + p.name + ".vtp"));
  }
  return plan;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    throw IoError(folder.string() + ": cannot be made a folder (" +
                  (error ? error.message() : "it is a file") + "); choose another output folder");
}

void refuse_existing(const Plan& plan) {
  for (const fs::path& file : plan.all())
    if (fs::exists(file))
      throw IoError(file.string() + ": already exists; use --force to replace it or another folder");
}

/// Verifies the blend faces of the STEP file that was just written.
void verify_step(JobResult& result, const StepContent& content) {
  for (BlendResult& blend : result.blends) {
    const auto face = std::find_if(content.faces.begin(), content.faces.end(),
                                   [&](const StepFace& f) { return f.name == blend.entry.name; });
    if (face == content.faces.end())
      throw IoError("the STEP file read back has no face named \"" + blend.entry.name + "\"");
    blend.stages.push_back(verify_blend(under_test(blend, face->surface), "step"));
  }
}

/// The shape's triangles, and the same per blend and per primary of the assembly with the measured errors.
struct Meshes {
  std::vector<TriMesh> all, blends, primaries;  ///< a primary of which nothing stays has an empty mesh
  std::vector<PolyLine> lines;
};

/// The meshes of all faces of that name as one.
TriMesh joined_mesh(const std::vector<TriMesh>& faces, const std::string& wanted) {
  TriMesh joined;
  for (const TriMesh& face : faces) {
    if (face.name != wanted) continue;
    if (joined.points.empty()) {
      joined = face;
      continue;
    }
    const auto first = static_cast<std::uint32_t>(joined.points.size());
    joined.points.insert(joined.points.end(), face.points.begin(), face.points.end());
    joined.normals.insert(joined.normals.end(), face.normals.begin(), face.normals.end());
    for (const auto& t : face.triangles)
      joined.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    for (std::size_t c = 0; c < joined.columns.size(); ++c)
      joined.columns[c].values.insert(joined.columns[c].values.end(), face.columns[c].values.begin(),
                                      face.columns[c].values.end());
  }
  return joined;
}

Meshes make_meshes(const JobResult& result, const Assembly& assembly, const Shape& shape) {
  Meshes m;
  double size = 0.0;
  for (const BlendResult& b : result.blends) {
    m.blends.push_back(blend_mesh(b, result.job.unit));
    for (PolyLine& line : trimline_lines(b, result.job.unit)) m.lines.push_back(std::move(line));
    for (const Vec3& p : m.blends.back().points)
      size = std::max(size, (p - m.blends.back().points[0]).norm());
  }
  m.all = tessellate(shape, 5e-4 * size, degrees(6.0));
  for (const PrimaryPatch& patch : assembly.primaries) {
    std::vector<PolyLine> lines;
    for (const PrimaryCut& cut : patch.cuts)
      lines.push_back(m.lines[2 * cut.blend + static_cast<std::size_t>(cut.side)]);
    m.primaries.push_back(joined_mesh(m.all, patch.name));
    add_seam_errors(m.primaries.back(), lines, result.job.unit);
  }
  return m;
}

void write_pictures(const JobResult& result, const Plan& plan, const Meshes& meshes, JobOutputs& outputs) {
  const Display display;
  if (!display.available()) {
    outputs.notes.push_back("pictures skipped: " + display.reason());
    return;
  }
  write_picture(plan.picture, error_picture(result, meshes.blends, meshes.primaries, meshes.lines), display);
  write_plots(plan.plots, error_plots(result), display);
  for (const fs::path& file : {plan.picture, plan.plots}) outputs.files.push_back({file, "png", 0});
}

void write_meshes(const JobResult& result, const Plan& plan, const Meshes& meshes, JobOutputs& outputs) {
  const auto wrote = [&](const fs::path& file, const char* kind) {
    outputs.files.push_back({file, kind, 0});
  };
  if (wants(result, OutputFormat::vtp)) {
    for (std::size_t i = 0; i < plan.blend_meshes.size(); ++i) {
      write_vtp(plan.blend_meshes[i], meshes.blends[i]);
      wrote(plan.blend_meshes[i], "vtp");
      write_vtp(plan.trimlines[i], std::span(meshes.lines).subspan(2 * i, 2));
      wrote(plan.trimlines[i], "vtp");
    }
    for (std::size_t i = 0; i < plan.primary_meshes.size(); ++i) {
      if (meshes.primaries[i].triangles.empty()) {
        outputs.notes.push_back(plan.primary_meshes[i].filename().string() +
                                ": not written, the trimline leaves nothing of this primary");
        continue;
      }
      write_vtp(plan.primary_meshes[i], meshes.primaries[i]);
      wrote(plan.primary_meshes[i], "vtp");
    }
  }
  if (!plan.stl.empty()) {
    write_stl(plan.stl, meshes.all);
    wrote(plan.stl, "stl");
  }
  if (!plan.obj.empty()) {
    write_obj(plan.obj, meshes.all);
    wrote(plan.obj, "obj");
  }
}

}  // namespace

JobOutputs write_outputs(JobResult& result, const WriteOptions& options, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  JobOutputs outputs;
  const Assembly assembly = assembly_of(result);
  const Plan plan = plan_files(result, assembly, options.folder);
  if (!options.overwrite) refuse_existing(plan);
  make_folder(options.folder);

  progress.at(0.5, "joining faces");
  const AssemblyResult joined = assemble(assembly, result.job.tolerance.position);
  result.warnings.insert(result.warnings.end(), joined.warnings.begin(), joined.warnings.end());
  if (!plan.step.empty()) {
    progress.at(0.6, "writing STEP");
    write_step(plan.step, joined.shape, {result.job.output.step_schema, result.job.unit, result.job.name});
    outputs.files.push_back({plan.step, "step", 0});
    progress.at(0.7, "verifying the STEP file");
    outputs.step = read_step(plan.step, result.job.unit);
    verify_step(result, *outputs.step);
  }
  if (plan.all().size() > 1 + outputs.files.size()) {
    progress.at(0.8, "writing meshes and pictures");
    const Meshes meshes = make_meshes(result, assembly, joined.shape);
    write_meshes(result, plan, meshes, outputs);
    if (!plan.picture.empty()) write_pictures(result, plan, meshes, outputs);
  }
  result.times.push_back(
      {"writing", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
  outputs.files.push_back({plan.report, "report", 0});
  for (WrittenFile& file : outputs.files)
    if (fs::exists(file.path)) file.bytes = static_cast<std::size_t>(fs::file_size(file.path));
  write_text_file(plan.report, report_json(result, &outputs, false));
  outputs.files.back().bytes = static_cast<std::size_t>(fs::file_size(plan.report));
  return outputs;
}

bool verified(const JobResult& result, const JobOutputs* outputs) {
  for (const BlendResult& blend : result.blends) {
    if (blend.stages.empty()) return false;
    const std::array<Continuity, 2> asked{blend.entry.sides[0].side.continuity,
                                          blend.entry.sides[1].side.continuity};
    for (const Finding& f : judge(blend.stages.back(), asked, result.job.tolerance, result.job.unit))
      if (f.failed) return false;
  }
  if (!outputs || !outputs->step) return true;
  const ShapeCheck& check = outputs->step->check;
  return check.valid && check.unexpected_free_edges == 0;
}

}  // namespace blendwright
