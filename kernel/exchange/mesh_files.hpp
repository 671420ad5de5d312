#pragma once
// Mesh files. Every writer goes through a temporary file and a rename: it throws IoError (where, why) and
// leaves nothing under `file` then, or InputError when a mesh contradicts itself (a column, normal or index
// that does not fit its points; a coordinate that is not finite). The same mesh gives the same bytes.
#include <filesystem>
#include <span>
#include <string>

#include "kernel/mesh/mesh.hpp"

namespace blendwright {

/// Points, normals and columns as 64-bit floats: nothing is rounded. Arrays are named "gap [mm]", with the
/// unit (also their UNITS_LABEL) unless the name ends with it ("angle_deg"); facts are field data under such
/// names, a column's labels the field data "<array> labels", the mesh's name the field data "name". `shown`
/// is the active array, which viewers colour by. Without triangles each point is a vertex cell, so that
/// viewers show it.
void write_vtp(const std::filesystem::path& file, const TriMesh& mesh);
/// One cell per line, with cell data "name" and "closed"; a closed line ends with its first point. A column
/// that only some lines have is NaN on the others. Note, facts and `shown` are those of the first line.
void write_vtp(const std::filesystem::path& file, std::span<const PolyLine> lines);
/// Binary, all meshes one after another; facet normals from the corners by the right-hand rule (0 without an
/// area). Coordinates are rounded to 32-bit floats. No names, point normals or columns.
void write_stl(const std::filesystem::path& file, std::span<const TriMesh> meshes);
/// One group per mesh, with point normals where the mesh has them; numbers read back to the same double. No
/// columns.
void write_obj(const std::filesystem::path& file, std::span<const TriMesh> meshes);

/// Binary little-endian, everything as 64-bit floats: nothing is rounded. Columns are further properties of
/// the vertices (blanks in names become "_", components get "_0", "_1", ...), without units.
void write_ply(const std::filesystem::path& file, const TriMesh& mesh);

/// Reads a .vtp, a binary .stl or .ply, or an .obj of triangles, for checks on what a user receives. Equal
/// corners of an STL become one point; the groups of an OBJ become one mesh. Throws IoError.
[[nodiscard]] TriMesh read_mesh(const std::filesystem::path& file);
/// The lines of a .vtp; closed where the last point is the first. Throws IoError.
[[nodiscard]] std::vector<PolyLine> read_polylines(const std::filesystem::path& file);

/// The extension in lower case, with its dot: what decides the format.
[[nodiscard]] std::string lower_case_extension(const std::filesystem::path& file);

}  // namespace blendwright
