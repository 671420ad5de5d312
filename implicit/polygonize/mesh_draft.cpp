#include "implicit/polygonize/mesh_draft.hpp"

#include <cmath>
#include <limits>

#include "implicit/polygonize/batches.hpp"

namespace blendwright::detail {
namespace {
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
}

void MeshDraft::set_vertex(std::size_t v, const SurfacePoint& point) {
  const double phi = inside(field.level(), point.value), slope = point.gradient.stableNorm();
  mesh.points[v] = point.at;
  value[v] = point.value;
  if (slope > 0.0) {
    mesh.normals[v] = -sense(field.level()) / slope * point.gradient;
    distance[v] = -phi / slope;
  } else {
    mesh.normals[v] = Vec3::Zero();
    distance[v] = phi == 0.0 ? 0.0 : nan;
  }
}

std::vector<GridEdge> crossed_edges(const BlockSurface& surface) {
  std::vector<GridEdge> edges;
  edges.reserve(surface.edge_vertices());
  surface.for_each_edge([&](const GridEdge& e) { edges.push_back(e); });
  return edges;
}

void add_columns(MeshDraft& draft, const Progress& progress, double from, double to) {
  TriMesh& mesh = draft.mesh;
  std::vector<double> mean(mesh.points.size(), nan), gaussian(mesh.points.size(), nan),
      member(mesh.points.size());
  for_each_in_batches(draft.blocks.size(), progress, from, to, "measuring curvature", [&](std::size_t b) {
    MeshBlock& block = draft.blocks[b];
    const std::size_t count = block.surface.vertices();
    if (count == 0) return;
    Points points;
    points.reserve(count);
    for (std::size_t n = 0; n < count; ++n) points.add(mesh.points[block.first_vertex + n]);
    FieldValues found{Order::hessian, count, std::vector<double>(components(Order::hessian) * count)};
    std::vector<std::uint32_t> nearest(count);
    const ScalarField::Model& model = *draft.live.blocks[b].model;
    model.evaluate(Order::hessian, points.arrays(), found.data);
    model.nearest_member(points.arrays(), nearest);
    block.evaluated += count;
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t v = block.first_vertex + n;
      member[v] = nearest[n];
      if (n >= block.surface.edge_vertices()) continue;  // the cap is not the field's surface
      const auto curvature = level_curvature(found.gradient(n), found.hessian(n), draft.field.level());
      if (!curvature) continue;
      mean[v] = curvature->mean;
      gaussian[v] = curvature->gaussian;
    }
  });
  mesh.columns = {{"value", "", 1, std::move(draft.value)},
                  {"distance_error", "", 1, std::move(draft.distance)},
                  {"mean_curvature", "", 1, std::move(mean)},
                  {"gaussian_curvature", "", 1, std::move(gaussian)},
                  {"member", "", 1, std::move(member)}};
}

}  // namespace blendwright::detail
