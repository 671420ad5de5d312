#include "app/pipeline/write_outputs.hpp"

#include <algorithm>

#include "app/json/job_reader.hpp"
#include "app/pipeline/output_plan.hpp"
#include "app/pipeline/result_facts.hpp"
#include "app/pipeline/result_meshes.hpp"
#include "app/pipeline/result_pictures.hpp"
#include "app/pipeline/second_surfaces.hpp"
#include "app/pipeline/staging.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/text_file.hpp"
#include "kernel/brep/shape_mesh.hpp"
#include "kernel/exchange/mesh_files.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;

/// Verifies the blend faces of the STEP file that was just written.
void verify_step(JobResult& result, const StepContent& content) {
  for (BlendResult& blend : result.blends) {
    const auto face = std::find_if(content.faces.begin(), content.faces.end(),
                                   [&](const StepFace& f) { return f.name == blend.entry.name; });
    if (face == content.faces.end())
      throw IoError("the STEP file read back has no face named \"" + blend.entry.name + "\"");
    BlendUnderTest on_file = under_test(blend, face->surface);
    // A hundredth of the tolerance: what assemble() promises of primaries that STEP has no entity for.
    on_file.second = second_surfaces(on_file, *face, content,
                                     {blend.entry.sides[0].primary, blend.entry.sides[1].primary},
                                     0.01 * result.job.tolerance.position);
    blend.stages.push_back(
        verify_blend(on_file, "step",
                     {.certify = result.options.certify, .fairness = result.options.fairness}));
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

Meshes make_meshes(const JobResult& result, const Assembly& assembly, const Shape* shape) {
  Meshes m;
  double size = 0.0;
  for (const BlendResult& b : result.blends) {
    m.blends.push_back(blend_mesh(b, result.job.unit));
    m.blends.back().facts = blend_facts(b, result.job);
    m.blends.back().shown = "gap";
    for (PolyLine& line : trimline_lines(b, result.job.unit)) {
      line.facts = m.blends.back().facts;
      line.shown = "gap";
      m.lines.push_back(std::move(line));
    }
    for (const Vec3& p : m.blends.back().points)
      size = std::max(size, (p - m.blends.back().points[0]).norm());
  }
  m.all = shape ? tessellate(*shape, 5e-4 * size, degrees(6.0)) : m.blends;
  for (TriMesh& mesh : m.all)
    for (const TriMesh& blend : m.blends)
      if (blend.name == mesh.name) mesh.note = blend.note;
  for (const PrimaryPatch& patch : assembly.primaries) {
    std::vector<PolyLine> lines;
    TriMesh primary = joined_mesh(m.all, patch.name);
    for (const PrimaryCut& cut : patch.cuts) {
      lines.push_back(m.lines[2 * cut.blend + static_cast<std::size_t>(cut.side)]);
      const std::vector<Column>& facts = m.blends[cut.blend].facts;
      primary.facts.insert(primary.facts.end(), facts.begin(), facts.end());
    }
    for (Column& c : primary.columns) c.unit = curvature_unit(c.name, result.job.unit);
    add_seam_errors(primary, lines, result.job.unit);
    primary.shown = "gap";
    m.primaries.push_back(std::move(primary));
  }
  return m;
}

void write_pictures(const JobResult& result, const OutputPlan& plan, const Meshes& meshes,
                    const StagingFolder& staging, JobOutputs& outputs) {
  const Display display;
  if (!display.available()) {
    outputs.notes.push_back("pictures skipped: " + display.reason());
    return;
  }
  write_picture(staging.of(plan.picture),
                error_picture(result, meshes.blends, meshes.primaries, meshes.lines), display);
  write_plots(staging.of(plan.plots), error_plots(result), display);
  for (const fs::path& file : {plan.picture, plan.plots}) outputs.files.push_back({file, "png", 0});
}

void write_meshes(const JobResult& result, const OutputPlan& plan, const Meshes& meshes,
                  const StagingFolder& staging, JobOutputs& outputs) {
  const auto wrote = [&](const fs::path& file, const char* kind) {
    outputs.files.push_back({file, kind, 0});
  };
  if (wants(result, OutputFormat::vtp)) {
    for (std::size_t i = 0; i < plan.blend_meshes.size(); ++i) {
      write_vtp(staging.of(plan.blend_meshes[i]), meshes.blends[i]);
      wrote(plan.blend_meshes[i], "vtp");
      write_vtp(staging.of(plan.trimlines[i]), std::span(meshes.lines).subspan(2 * i, 2));
      wrote(plan.trimlines[i], "vtp");
    }
    for (std::size_t i = 0; i < plan.primary_meshes.size(); ++i) {
      if (meshes.primaries[i].triangles.empty()) {
        outputs.notes.push_back(plan.primary_meshes[i].filename().string() + ": not written, " +
                                (outputs.not_joined.empty() ? "the trimline leaves nothing of this primary"
                                                            : "the faces could not be joined"));
        continue;
      }
      write_vtp(staging.of(plan.primary_meshes[i]), meshes.primaries[i]);
      wrote(plan.primary_meshes[i], "vtp");
    }
  }
  if (!plan.stl.empty()) {
    write_stl(staging.of(plan.stl), meshes.all);
    wrote(plan.stl, "stl");
  }
  if (!plan.obj.empty()) {
    write_obj(staging.of(plan.obj), meshes.all);
    wrote(plan.obj, "obj");
  }
}

/// The joined faces; empty, with the reason in the outputs, when they do not fit together.
std::optional<AssemblyResult> join(JobResult& result, const Assembly& assembly, JobOutputs& outputs) {
  try {
    AssemblyResult joined = assemble(assembly, result.job.tolerance.position);
    result.warnings.insert(result.warnings.end(), joined.warnings.begin(), joined.warnings.end());
    return joined;
  } catch (const GeometryError& e) {
    outputs.not_joined = e.what();
    return std::nullopt;
  }
}

void write_joined(JobResult& result, const OutputPlan& plan, const Shape& shape, const StagingFolder& staging,
                  const Progress& progress, JobOutputs& outputs) {
  if (plan.step.empty()) return;
  progress.at(0.6, "writing STEP");
  const fs::path staged = staging.of(plan.step);
  write_step(staged, shape,
             {result.job.output.step_schema, result.job.unit, result.job.name, shape_note(result)});
  progress.at(0.7, "verifying the STEP file");
  outputs.step = read_step(staged, result.job.unit);
  verify_step(result, *outputs.step);
  outputs.files.push_back({plan.step, "step", 0});
}

}  // namespace

JobOutputs write_outputs(JobResult& result, const WriteOptions& options, const Progress& progress) {
  StopWatch watch;
  JobOutputs outputs;
  const Assembly assembly = assembly_of(result);
  const OutputPlan plan = plan_outputs(result, assembly, options.folder);
  if (!options.overwrite) refuse_existing(plan.all());
  StagingFolder staging(options.folder);
  try {
    progress.at(0.5, "joining faces");
    const std::optional<AssemblyResult> joined = join(result, assembly, outputs);
    if (joined) write_joined(result, plan, joined->shape, staging, progress, outputs);
    if (plan.all().size() > 1 + (plan.step.empty() ? 0u : 1u)) {
      progress.at(0.8, "writing meshes and pictures");
      const Meshes meshes = make_meshes(result, assembly, joined ? &joined->shape : nullptr);
      write_meshes(result, plan, meshes, staging, outputs);
      if (!plan.picture.empty()) write_pictures(result, plan, meshes, staging, outputs);
    }
    result.times.push_back({"writing", watch.lap()});
    for (WrittenFile& file : outputs.files)
      file.bytes = static_cast<std::size_t>(fs::file_size(staging.of(file.path)));
    write_text_file(staging.of(plan.report), report_json(result, &outputs, options.times));
    outputs.files.push_back(
        {plan.report, "report", static_cast<std::size_t>(fs::file_size(staging.of(plan.report)))});
    std::vector<fs::path> files;
    for (const WrittenFile& file : outputs.files) files.push_back(file.path);
    staging.publish(files);
  } catch (const IoError& e) {
    throw staging.with_final_names(e);
  }
  return outputs;
}

std::vector<std::string> shape_problems(const JobResult& result, const JobOutputs& outputs) {
  std::vector<std::string> problems;
  if (!outputs.not_joined.empty())
    problems.push_back("no joined shape and no STEP file: " + outputs.not_joined);
  if (!outputs.step) return problems;
  const ShapeCheck& check = outputs.step->check;
  const std::string unit = name(result.job.unit);
  if (!check.valid) problems.push_back("the STEP file's shape is not valid");
  problems.insert(problems.end(), check.problems.begin(), check.problems.end());
  if (check.unexpected_free_edges > 0)
    problems.push_back(std::to_string(check.unexpected_free_edges) +
                       " trimline edge(s) of the STEP file not shared by two faces");
  const double allowed =
      std::max(result.job.tolerance.position, 1e-7);  // 1e-7: what a reader gives everything
  if (check.largest_tolerance > 1.001 * allowed)
    problems.push_back("largest tolerance " + scientific_text(check.largest_tolerance) + " " + unit +
                       " of the STEP file read back exceeds " + scientific_text(allowed) + " " + unit);
  return problems;
}

bool verified(const JobResult& result, const JobOutputs* outputs) {
  if (!program_defects(result).empty()) return false;
  for (const BlendResult& blend : result.blends) {
    if (blend.stages.empty()) return false;
    const std::array<Continuity, 2> asked{blend.entry.sides[0].side.continuity,
                                          blend.entry.sides[1].side.continuity};
    for (const Finding& f : judge(blend.stages.back(), asked, result.job.tolerance, result.job.unit))
      if (f.failed) return false;
  }
  return !outputs || shape_problems(result, *outputs).empty();
}

}  // namespace blendwright
