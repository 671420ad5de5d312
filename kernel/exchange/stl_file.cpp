// Binary STL: 80 bytes of header, the number of triangles, then 50 bytes each: normal and three corners as
// 32-bit floats, two bytes of attributes. Coordinates are rounded to 24 bits; points are not shared.
#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <map>

#include "kernel/base/error.hpp"
#include "kernel/base/text_file.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "kernel/exchange/mesh_formats.hpp"

namespace blendwright {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

constexpr std::size_t header_bytes = 80, count_bytes = 4, triangle_bytes = 50;
using Corner = std::array<float, 3>;

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Zero has one sign, so that equal corners have equal bytes.
Corner corner(const Vec3& p) {
  return {static_cast<float>(p.x()) + 0.0f, static_cast<float>(p.y()) + 0.0f,
          static_cast<float>(p.z()) + 0.0f};
}

void append_triangle(std::string& bytes, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const double length = n.norm();
  append(bytes, corner(length > 0.0 ? Vec3(n / length) : Vec3::Zero()));
  for (const Vec3* p : {&a, &b, &c}) append(bytes, corner(*p));
  append(bytes, std::uint16_t{0});
}

}  // namespace

void write_stl(const std::filesystem::path& file, std::span<const TriMesh> meshes) {
  std::size_t triangles = 0;
  for (const TriMesh& mesh : meshes) {
    require_consistent(mesh);
    triangles += mesh.triangles.size();
  }
  if (triangles > std::numeric_limits<std::uint32_t>::max())
    throw InputError("triangles", "are " + std::to_string(triangles) + ", STL holds at most 4294967295");

  std::string bytes = "binary STL written by blendwright";
  bytes.resize(header_bytes, ' ');
  bytes.reserve(header_bytes + count_bytes + triangles * triangle_bytes);
  append(bytes, static_cast<std::uint32_t>(triangles));
  for (const TriMesh& mesh : meshes)
    for (const auto& t : mesh.triangles)
      append_triangle(bytes, mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
  write_text_file(file, bytes);
}

TriMesh read_stl(const std::filesystem::path& file) {
  const std::string bytes = read_text_file(file, largest_mesh_file);
  std::uint32_t count = 0;
  if (bytes.size() >= header_bytes + count_bytes)
    std::memcpy(&count, bytes.data() + header_bytes, sizeof count);
  const std::size_t expected = header_bytes + count_bytes + std::size_t{count} * triangle_bytes;
  if (bytes.size() != expected)
    fail_reading(file, "it is not a binary STL: " + std::to_string(bytes.size()) +
                           " bytes, its count of triangles makes " + std::to_string(expected));

  TriMesh mesh;
  mesh.name = file.stem().string();
  mesh.triangles.reserve(count);
  std::map<Corner, std::uint32_t> known;  // equal corners become one point, so a closed mesh stays closed
  for (std::uint32_t t = 0; t < count; ++t) {
    std::array<Corner, 3> corners;
    const std::size_t at = header_bytes + count_bytes + t * triangle_bytes + sizeof(Corner);
    std::memcpy(corners.data(), bytes.data() + at, sizeof corners);
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p(corners[k][0], corners[k][1], corners[k][2]);
      if (!p.allFinite()) fail_reading(file, "triangle " + std::to_string(t) + " is not finite");
      const auto [entry, added] =
          known.try_emplace(corner(p), static_cast<std::uint32_t>(mesh.points.size()));
      if (added) mesh.points.push_back(p);
      triangle[k] = entry->second;
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace blendwright
