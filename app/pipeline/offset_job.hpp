#pragma once
// Scene -> offset of its solid -> mesh, files, and how far the offset is from the exact one.
#include <optional>
#include <string>
#include <vector>

#include "app/pipeline/mesh_job.hpp"
#include "implicit/offset/offset_error.hpp"

namespace blendwright {

struct OffsetRequest {
  enum class Kind { ball, normal, iso, shell, round, fillet } kind = Kind::ball;
  double distance = 0.0;            ///< of ball and normal: a length; of iso: a value of the field. > 0 grows
  double inner = 0.0, outer = 0.0;  ///< of shell: how far the wall reaches inward and outward, >= 0
  double radius = 0.0;              ///< of round (convex edges) and fillet (concave edges)
  std::optional<double> tolerance{};  ///< of all but normal and iso: how well values are enclosed
};

/// The scene with one more node: the offset of its solid, which becomes the solid. Throws InputError
/// ("--distance", "--shell", "--round", "--fillet", "--tolerance").
[[nodiscard]] SceneFile offset_scene(const SceneFile& scene, const OffsetRequest& request);

/// How far the points of the original surface, moved along their normals, are from an offset surface.
struct OffsetCheck {
  std::string of;  ///< "offset", "inner offset", "outer offset"
  double distance = 0.0;
  OffsetError error;
};

struct OffsetResult {
  SceneFile scene;  ///< of the offset
  MeshResult mesh;
  std::vector<OffsetCheck> checks;  ///< none for round and fillet, which are no offset by one distance
  std::vector<std::string> notes;
};

/// Meshes and writes the offset with run_mesh_job(). Throws GeometryError also when the offset leaves
/// nothing, and says whether that is proven.
[[nodiscard]] OffsetResult run_offset_job(const SceneFile& original, const OffsetRequest& request,
                                          const MeshJob& job, const Progress& progress = {});

/// mesh_report_json() with the object "offset".
[[nodiscard]] std::string offset_report_json(const OffsetRequest& request, const OffsetResult& result,
                                             bool times);
/// "ball", "normal", "iso", "shell", "round", "fillet".
[[nodiscard]] std::string_view name(OffsetRequest::Kind kind);
/// What was asked: "the offset by -2 mm", "the shell of 1 inward and 0 mm outward", "the rounding by 0.5 mm".
[[nodiscard]] std::string offset_text(const OffsetRequest& request, LengthUnit unit);

}  // namespace blendwright
