#pragma once
// What a picture can be of: a job, a scene, a STEP file, a mesh file, or a folder that `blend` wrote.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/json/scene_reader.hpp"
#include "app/pipeline/run_job.hpp"
#include "kernel/mesh/mesh.hpp"

namespace blendwright {

/// One surface. Curvatures of jobs, scenes and STEP files are positive where the surface is convex seen from
/// the side that its normals point to; those of mesh files are what the file says.
struct PicturePart {
  enum class Role {
    blend,    ///< has figures of joints
    primary,  ///< joined by blends
    other
  } role = Role::other;
  TriMesh mesh;
  std::optional<Surface> surface{};  ///< in the parameters of the columns u and v, when the mesh is of one
};

struct PictureInput {
  enum class Kind { job, scene, step, mesh } kind = Kind::mesh;
  std::string name;  ///< stem of the file or name of the folder
  std::optional<LengthUnit> unit{};
  std::vector<PicturePart> parts{};
  std::vector<PolyLine> lines{};  ///< trimlines
  std::optional<JobResult> job{};
  std::optional<SceneFile> scene{};
  std::vector<std::string> notes{};
};

struct PictureInputOptions {
  std::string solid{};       ///< of a scene; empty: its own
  std::size_t cells = 160;   ///< of a scene, along the longest side
  std::optional<Box> box{};  ///< of a scene; none: around the solid
  /// false: a scene's mesh, a job's primaries are left out (not all pictures need them).
  bool surfaces = true;
};

/// Of a job that was run.
[[nodiscard]] PictureInput picture_input(JobResult result);

/// "-": a job or a scene from standard input. Throws InputError (the file's problems; an extension that is
/// not known), IoError, and what run_job and run_mesh_job throw.
[[nodiscard]] PictureInput read_picture_input(const std::string& file, const PictureInputOptions& options,
                                              const Progress& progress = {});

}  // namespace blendwright
