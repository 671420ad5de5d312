#pragma once
// Private to the mesh files: one reader per format, and what every writer checks first.
#include <filesystem>
#include <string>
#include <string_view>

#include "kernel/mesh/mesh.hpp"

namespace blendwright {

/// Throws InputError when a column, a normal or an index does not fit the points, or a coordinate is not
/// finite.
void require_consistent(const TriMesh& mesh);
void require_consistent(const PolyLine& line);

/// Throws IoError: `file` cannot be used because `why`.
[[noreturn]] void fail_reading(const std::filesystem::path& file, const std::string& why);
/// The largest mesh file that is read.
inline constexpr std::size_t largest_mesh_file = std::size_t{4} << 30;

[[nodiscard]] TriMesh read_vtp(const std::filesystem::path& file);
[[nodiscard]] TriMesh read_stl(const std::filesystem::path& file);
[[nodiscard]] TriMesh read_obj(const std::filesystem::path& file);
[[nodiscard]] TriMesh read_ply(const std::filesystem::path& file);

/// The points of a .vtp, whatever its cells are.
[[nodiscard]] std::vector<Vec3> read_vtp_points(const std::filesystem::path& file);

}  // namespace blendwright
