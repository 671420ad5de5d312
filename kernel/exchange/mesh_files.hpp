#pragma once
// Mesh files. Every writer goes through a temporary file and a rename, and throws IoError.
#include <filesystem>
#include <span>

#include "kernel/mesh/mesh.hpp"

namespace blendwright {

void write_vtp(const std::filesystem::path& file, const TriMesh& mesh);      ///< point data, normals, binary XML
void write_vtp(const std::filesystem::path& file, std::span<const PolyLine> lines);
void write_stl(const std::filesystem::path& file, std::span<const TriMesh> meshes);   ///< binary
void write_obj(const std::filesystem::path& file, std::span<const TriMesh> meshes);   ///< one group per mesh, normals

/// Reads a .vtp, .stl or .obj back as points, triangles and scalar columns (for checks on what a user receives).
[[nodiscard]] TriMesh read_mesh(const std::filesystem::path& file);
[[nodiscard]] std::vector<PolyLine> read_polylines(const std::filesystem::path& file);

}  // namespace blendwright
