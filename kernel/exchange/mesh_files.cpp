#include "kernel/exchange/mesh_files.hpp"

#include <algorithm>
#include <cctype>

#include "kernel/base/error.hpp"
#include "kernel/exchange/mesh_formats.hpp"

namespace blendwright {
namespace {

void require_finite(const std::vector<Vec3>& vectors, const char* what, const std::string& owner) {
  for (std::size_t i = 0; i < vectors.size(); ++i)
    if (!vectors[i].allFinite())
      throw InputError(owner + what + "/" + std::to_string(i), "is not finite, must be three finite numbers");
}

void require_rows(const std::vector<Column>& columns, std::size_t points, const std::string& owner) {
  for (const Column& c : columns) {
    const std::size_t expected = static_cast<std::size_t>(std::max(c.components, 0)) * points;
    if (c.name.empty()) throw InputError(owner + "columns", "has a column without a name, must name each");
    if (c.components < 1)
      throw InputError(owner + "columns/" + c.name,
                       "has " + std::to_string(c.components) + " components, must have at least 1");
    if (c.values.size() != expected)
      throw InputError(owner + "columns/" + c.name, "has " + std::to_string(c.values.size()) +
                                                        " values, must have " + std::to_string(expected) +
                                                        ": " + std::to_string(c.components) + " per point");
  }
}

void require_whole_rows(const std::vector<Column>& facts, const std::string& owner) {
  for (const Column& c : facts)
    if (c.name.empty() || c.components < 1 || c.values.size() % static_cast<std::size_t>(c.components) != 0)
      throw InputError(owner + "facts/" + c.name, "has " + std::to_string(c.values.size()) +
                                                      " values in rows of " + std::to_string(c.components) +
                                                      ", must have a name and whole rows");
}

std::string owner_of(const std::string& name) { return name.empty() ? "" : name + "/"; }

}  // namespace

void require_consistent(const TriMesh& mesh) {
  const std::string owner = owner_of(mesh.name);
  require_finite(mesh.points, "points", owner);
  require_finite(mesh.normals, "normals", owner);
  require_rows(mesh.columns, mesh.points.size(), owner);
  require_whole_rows(mesh.facts, owner);
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.points.size())
    throw InputError(owner + "normals", "has " + std::to_string(mesh.normals.size()) +
                                            " vectors, must have none or " +
                                            std::to_string(mesh.points.size()) + ": one per point");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t i : mesh.triangles[t])
      if (i >= mesh.points.size())
        throw InputError(
            owner + "triangles/" + std::to_string(t),
            "names point " + std::to_string(i) + ", must be below " + std::to_string(mesh.points.size()));
}

void require_consistent(const PolyLine& line) {
  const std::string owner = owner_of(line.name);
  require_finite(line.points, "points", owner);
  require_rows(line.columns, line.points.size(), owner);
  require_whole_rows(line.facts, owner);
  const std::size_t least = line.closed ? 3 : 2;
  if (line.points.size() < least)
    throw InputError(owner + "points", "has " + std::to_string(line.points.size()) + ", must have at least " +
                                           std::to_string(least));
}

void fail_reading(const std::filesystem::path& file, const std::string& why) {
  throw IoError(file.string() + ": cannot be read (" + why + ")");
}

std::string lower_case_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

TriMesh read_mesh(const std::filesystem::path& file) {
  const std::string extension = lower_case_extension(file);
  if (extension == ".vtp") return read_vtp(file);
  if (extension == ".stl") return read_stl(file);
  if (extension == ".obj") return read_obj(file);
  if (extension == ".ply") return read_ply(file);
  fail_reading(file, "the extension is \"" + extension + "\", must be .vtp, .stl, .obj or .ply");
}

}  // namespace blendwright
