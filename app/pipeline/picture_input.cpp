#include "app/pipeline/picture_input.hpp"

#include <algorithm>
#include <limits>

#include "app/json/job_reader.hpp"
#include "app/json/json_value.hpp"
#include "app/json/object_reader.hpp"
#include "app/pipeline/mesh_job.hpp"
#include "app/pipeline/progress_part.hpp"
#include "app/pipeline/result_meshes.hpp"
#include "app/pipeline/show.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/brep/shape_mesh.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "kernel/exchange/step_shape.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;

using Role = PicturePart::Role;

constexpr double built = 0.8;   // of the progress, by the time that a job is built
constexpr double chord = 1e-3;  // of the size: triangles of CAD faces
constexpr Radians facet_turn = degrees(7.5);

double size_of(const std::vector<TriMesh>& meshes) {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::max()), hi = -lo;
  for (const TriMesh& mesh : meshes)
    for (const Vec3& p : mesh.points) {
      lo = lo.cwiseMin(p);
      hi = hi.cwiseMax(p);
    }
  return lo.x() <= hi.x() ? (hi - lo).norm() : 0.0;
}

/// Curvatures of surfaces are positive where they bend towards the normal.
void make_convex_positive(TriMesh& mesh) {
  for (Column& c : mesh.columns)
    if (c.name == "mean_curvature")
      for (double& x : c.values) x = -x;
}

/// Normals and triangles towards the other side.
void turn(TriMesh& mesh) {
  for (Vec3& n : mesh.normals) n = -n;
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  make_convex_positive(mesh);
}

void add_units(TriMesh& mesh, LengthUnit unit) {
  const std::string length = name(unit);
  for (Column& c : mesh.columns) {
    if (c.name == "mean_curvature") c.unit = "1/" + length;
    if (c.name == "gaussian_curvature") c.unit = "1/" + length + "^2";
  }
}

/// Six times the volume under the triangles of each mesh, seen from its own middle: 0 for planes, negative
/// when the normals of what is round point inward.
double signed_volume(const std::vector<TriMesh>& meshes) {
  double volume = 0.0;
  for (const TriMesh& mesh : meshes) {
    Vec3 middle = Vec3::Zero();
    double area = 0.0;
    for (const auto& t : mesh.triangles) {
      const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
      const double part = (b - a).cross(c - a).norm();
      middle += part * (a + b + c) / 3.0;
      area += part;
    }
    if (area > 0.0) middle /= area;
    for (const auto& t : mesh.triangles)
      volume +=
          (mesh.points[t[0]] - middle).dot((mesh.points[t[1]] - middle).cross(mesh.points[t[2]] - middle));
  }
  return volume;
}

bool is_blend(const JobResult& result, const std::string& name) {
  return std::any_of(result.blends.begin(), result.blends.end(),
                     [&](const BlendResult& b) { return b.entry.name == name; });
}

/// The trimmed primaries; blends are turned to the side that the joined shape has them on.
std::vector<TriMesh> joined_primaries(const JobResult& result, std::vector<TriMesh>& blends) {
  const AssemblyResult joined = assemble(assembly_of(result), result.job.tolerance.position);
  std::vector<TriMesh> primaries =
      tessellate(joined.shape, chord * size_of(blends), facet_turn,
                 [&](const std::string& name) { return !is_blend(result, name); });
  for (const FaceSide& side : sides_of_faces(joined.shape))
    for (TriMesh& blend : blends)
      if (blend.name == side.name && side.reversed) turn(blend);
  if (signed_volume(primaries) < 0.0) {  // an open shell may have either side outside
    for (TriMesh& mesh : primaries) turn(mesh);
    for (TriMesh& mesh : blends) turn(mesh);
  }
  return primaries;
}

void add_job_parts(PictureInput& input, bool primaries) {
  const JobResult& result = *input.job;
  std::vector<TriMesh> blends, others;
  for (const BlendResult& b : result.blends) {
    blends.push_back(blend_mesh(b, result.job.unit));
    for (PolyLine& line : trimline_lines(b, result.job.unit)) input.lines.push_back(std::move(line));
  }
  if (primaries) {
    try {
      others = joined_primaries(result, blends);
    } catch (const GeometryError& e) {
      input.notes.push_back(std::string("without the primaries: ") + e.what());
    }
  }
  for (std::size_t i = 0; i < blends.size(); ++i) {
    make_convex_positive(blends[i]);
    input.parts.push_back({Role::blend, std::move(blends[i]), Surface(result.blends[i].fit.surface)});
  }
  for (TriMesh& mesh : others) {
    add_units(mesh, result.job.unit);
    make_convex_positive(mesh);
    input.parts.push_back({Role::primary, std::move(mesh), {}});
  }
}

PictureInput of_result(JobResult result, bool primaries) {
  PictureInput input;
  input.kind = PictureInput::Kind::job;
  input.name = result.job.name;
  input.unit = result.job.unit;
  input.notes = result.warnings;
  input.job = std::move(result);
  add_job_parts(input, primaries);
  return input;
}

PictureInput of_job(const JobSpec& job, const PictureInputOptions& options, const Progress& progress) {
  JobResult result = run_job(job, part_of(progress, 0.0, built));
  progress.at(built, "meshing " + job.name);
  return of_result(std::move(result), options.surfaces);
}

PictureInput of_scene(SceneFile scene, const PictureInputOptions& options, const Progress& progress) {
  PictureInput input;
  input.kind = PictureInput::Kind::scene;
  input.name = scene.name;
  if (scene.spec.solid != scene.name && scene.spec.solid.rfind('/', 0) != 0)
    input.name += ": " + scene.spec.solid;
  input.unit = scene.spec.unit;
  if (options.surfaces) {
    MeshJob job;
    job.cells = options.cells;
    job.box = options.box;
    input.parts.push_back({Role::other, run_mesh_job(scene, job, progress).made.mesh, {}});
  }
  input.scene = std::move(scene);
  return input;
}

PictureInput of_step(const fs::path& file) {
  PictureInput input;
  input.kind = PictureInput::Kind::step;
  input.name = file.stem().string();
  input.unit = LengthUnit::millimetre;
  const StepShape read = read_step_shape(file);
  // Coarse first: the fine triangles are measured in sizes of the part.
  const double size = size_of(tessellate(read.shape, std::numeric_limits<float>::max(), degrees(40.0)));
  std::vector<TriMesh> faces = tessellate(read.shape, chord * size, facet_turn);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    add_units(faces[i], *input.unit);
    make_convex_positive(faces[i]);
    input.parts.push_back({Role::other, std::move(faces[i]), read.surfaces[i]});
  }
  return input;
}

bool has(const TriMesh& mesh, const char* column) { return find_column(mesh, column) != nullptr; }

/// A unit of length that a column of the mesh is told in.
std::optional<LengthUnit> unit_of(const TriMesh& mesh) {
  for (const Column& c : mesh.columns)
    for (const Choice<LengthUnit>& choice : unit_choices())
      if (c.unit == name(choice.value)) return choice.value;
  return std::nullopt;
}

void add_mesh_file(PictureInput& input, const fs::path& file) {
  TriMesh mesh = read_mesh(file);
  if (mesh.triangles.empty() && lower_case_extension(file) == ".vtp") {
    for (PolyLine& line : read_polylines(file)) input.lines.push_back(std::move(line));
    return;
  }
  if (mesh.name.empty()) mesh.name = file.stem().string();
  if (!input.unit) input.unit = unit_of(mesh);
  const Role role = has(mesh, "fit_deviation") ? Role::blend : has(mesh, "gap") ? Role::primary : Role::other;
  input.parts.push_back({role, std::move(mesh), {}});
}

PictureInput of_mesh_file(const fs::path& file) {
  PictureInput input;
  input.name = file.stem().string();
  add_mesh_file(input, file);
  if (input.parts.empty() && input.lines.empty())
    throw InputError("", "has neither triangles nor lines, must have some to be seen");
  return input;
}

/// Every .vtp of the folder.
PictureInput of_folder(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (lower_case_extension(entry.path()) == ".vtp") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  if (files.empty())
    throw InputError("", "is a folder without .vtp files, must be one that \"blendwright blend\" wrote");
  PictureInput input;
  input.name = fs::weakly_canonical(folder).filename().string();
  for (const fs::path& file : files) add_mesh_file(input, file);
  return input;
}

/// A scene has nodes; anything else is read as a job, whose reader says what is wrong with it.
PictureInput of_json(const std::string& file, const PictureInputOptions& options, const Progress& progress) {
  const std::string text = read_json_text(file);
  bool scene = false;
  try {
    scene = parse_json(text).find("nodes") != nullptr;
  } catch (const InputError&) {
    scene = false;
  }
  return scene ? of_scene(build_scene_text(text, file, options.solid), options, progress)
               : of_job(read_job(text, file), options, progress);
}

}  // namespace

PictureInput picture_input(JobResult result) { return of_result(std::move(result), true); }

PictureInput read_picture_input(const std::string& file, const PictureInputOptions& options,
                                const Progress& progress) {
  const std::string extension = lower_case_extension(file);
  const auto one_of = [&](std::initializer_list<const char*> list) {
    return std::find(list.begin(), list.end(), extension) != list.end();
  };
  if (file == "-" || extension == ".json") return of_json(file, options, progress);
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) return of_folder(file);
  progress.at(0.0, "reading " + fs::path(file).filename().string());
  if (one_of({".step", ".stp"})) return of_step(file);
  if (one_of({".vtp", ".stl", ".obj", ".ply"})) return of_mesh_file(file);
  throw InputError("",
                   "is " + in_quotes(file) +
                       ", must be a job or a scene (.json), .step, .vtp, .stl, .obj, .ply, or a folder that "
                       "\"blendwright blend\" wrote");
}

}  // namespace blendwright
