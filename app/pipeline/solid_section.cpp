#include "app/pipeline/solid_section.hpp"

#include <algorithm>
#include <map>

#include "implicit/polygonize/polygonize.hpp"

namespace blendwright {
namespace {

constexpr double cells = 96.0;  // along the longest side

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// The triangles with only the points that they use.
TriMesh part_of(const TriMesh& mesh, const Triangles& triangles, bool normals) {
  TriMesh part;
  std::vector<std::uint32_t> index(mesh.points.size(), static_cast<std::uint32_t>(-1));
  for (auto t : triangles) {
    for (std::uint32_t& i : t) {
      if (index[i] == static_cast<std::uint32_t>(-1)) {
        index[i] = static_cast<std::uint32_t>(part.points.size());
        part.points.push_back(mesh.points[i]);
        if (normals) part.normals.push_back(mesh.normals[i]);
      }
      i = index[i];
    }
    part.triangles.push_back(t);
  }
  return part;
}

std::vector<std::array<std::uint32_t, 2>> border_of(const TriMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++uses[std::minmax(t[i], t[(i + 1) % 3])];
  std::vector<std::array<std::uint32_t, 2>> border;
  for (const auto& [edge, count] : uses)
    if (count == 1) border.push_back({edge.first, edge.second});
  return border;
}

}  // namespace

SolidSection cut_open(const ScalarField& solid, Box box, const std::optional<Cut>& cut,
                      const Progress& progress) {
  MeshOptions options;
  options.cell = box.size().maxCoeff() / cells;
  if (cut && cut->at > box.lo[cut->k] && cut->at < box.hi[cut->k])
    (cut->sense > 0.0 ? box.hi : box.lo)[cut->k] = cut->at;
  options.box = box;
  options.columns = false;
  TriMesh mesh;
  try {
    mesh = polygonize(solid, options, progress).mesh;
  } catch (const GeometryError&) {
    return {};
  }
  Triangles outside, inside;
  for (const auto& t : mesh.triangles) {
    const bool in_cut = cut && std::all_of(t.begin(), t.end(), [&](std::uint32_t i) {
                          return mesh.points[i][cut->k] == cut->at;
                        });
    (in_cut ? inside : outside).push_back(t);
  }
  SolidSection result{part_of(mesh, outside, true), part_of(mesh, inside, false), {}};
  result.outline = border_of(result.section);
  return result;
}

}  // namespace blendwright
