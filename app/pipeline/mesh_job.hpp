#pragma once
// Scene -> mesh -> files.
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/json/scene_reader.hpp"
#include "app/pipeline/stage_time.hpp"
#include "app/pipeline/staging.hpp"
#include "implicit/polygonize/polygonize.hpp"

namespace blendwright {

struct MeshJob {
  std::optional<double> cell{};  ///< edge length of a cell, model units
  std::size_t cells = 128;       ///< along the longest side of the box, when `cell` is not given
  std::optional<Box> box{};      ///< none: around the solid
  MeshOptions::AtBox at_box = MeshOptions::AtBox::cap;
  std::size_t max_memory = std::size_t{4} << 30;
  /// Their extensions choose the formats; none: only the figures are wanted.
  std::vector<std::filesystem::path> outputs{};
  bool overwrite = false;
  std::string colour{};  ///< column that colours a picture; empty: plain
};

struct MeshResult {
  MeshOptions options;
  FieldMesh made;
  std::vector<WrittenFile> files;
  std::vector<std::string> notes{};  ///< e.g. "pictures skipped: ..."
  std::vector<StageTime> times{};
};

struct NamedRow {
  std::string_view name, description;
};
/// Extensions that meshes are written with.
[[nodiscard]] std::span<const NamedRow> mesh_formats();
/// Columns of the mesh's points.
[[nodiscard]] std::span<const NamedRow> mesh_columns();

/// Makes the mesh and writes it; all files appear together or none does. Throws InputError ("--cell",
/// "--box",
/// "--max-memory", "--output", "--colour": what the program calls them), GeometryError when nothing of the
/// solid's surface lies in the box, IoError, Cancelled.
[[nodiscard]] MeshResult run_mesh_job(const SceneFile& scene, const MeshJob& job,
                                      const Progress& progress = {});

/// The result as JSON text; clock readings only when `times`.
[[nodiscard]] std::string mesh_report_json(const SceneFile& scene, const MeshResult& result, bool times);

}  // namespace blendwright
