#include "implicit/polygonize/polygonize.hpp"

#include <cmath>
#include <limits>

#include "implicit/polygonize/batches.hpp"
#include "implicit/polygonize/memory_need.hpp"
#include "implicit/polygonize/mesh_draft.hpp"
#include "implicit/polygonize/mesh_facts.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace detail {
namespace {

CellGrid grid_for(const ScalarField& field, const MeshOptions& options) {
  if (!(options.cell > 0.0) || !std::isfinite(options.cell))
    throw InputError("cell", "is " + number_text(options.cell) + ", must be a length > 0");
  if (options.newton_steps < 0)
    throw InputError("newton_steps", "is " + number_text(options.newton_steps) + ", must be >= 0");
  if (options.box) return CellGrid::in(*options.box, options.cell);
  if (!field.bounds() || !field.bounds()->finite())
    throw InputError("box", "is missing, and the solid has no finite bounds of its own; give a box");
  return CellGrid::around(*field.bounds(), options.cell);
}

/// Values at the corners of a block, and what they say of the surface.
MeshBlock sampled(const MeshDraft& draft, std::size_t b) {
  const LiveBlock& live = draft.live.blocks[b];
  MeshBlock block;
  block.place = BlockPlace(draft.grid, live.at);
  const BlockPlace& place = block.place;
  if (live.inside) {
    block.surface = BlockSurface::full(place, draft.cap());
    count_triangles(block, draft.cap());
    return block;
  }
  const Points corners = corner_points(draft.grid, place);
  std::vector<double> values(corners.size());
  live.model->evaluate(Order::value, corners.arrays(), values);
  block.evaluated = corners.size();
  for (double& v : values) v = inside(draft.field.level(), v);
  block.surface = BlockSurface(place, values, draft.cap());
  block.start.reserve(block.surface.edge_vertices());
  block.surface.for_each_edge([&](const GridEdge& e) {
    const std::array step{1, place.cells[0] + 1, (place.cells[0] + 1) * (place.cells[1] + 1)};
    const std::size_t corner = place.corner(e.i, e.j, e.k);
    const auto next = corner + static_cast<std::size_t>(step[static_cast<std::size_t>(e.axis)]);
    block.start.push_back(linear_crossing(values[corner], values[next]));
  });
  count_triangles(block, draft.cap());
  return block;
}

[[noreturn]] void refuse_empty(const MeshDraft& draft) {
  const Box& box = draft.grid.box();
  const auto corner = [](const Vec3& p) {
    return "(" + number_text(p.x(), 6) + ", " + number_text(p.y(), 6) + ", " + number_text(p.z(), 6) + ")";
  };
  throw GeometryError("nothing of the surface lies in the box from " + corner(box.lo) + " to " +
                      corner(box.hi) + ": at cells of " + number_text(draft.grid.cell(), 6) +
                      (draft.facts.cut_by_box ? " every grid point is inside the solid"
                                              : " no grid point is inside the solid; try smaller cells"));
}

/// First numbers of every block's vertices and triangles; refuses meshes that are too large.
void number(MeshDraft& draft) {
  std::size_t vertices = 0, on_edges = 0, surface = 0, cap = 0;
  for (MeshBlock& block : draft.blocks) {
    block.first_vertex = static_cast<std::uint32_t>(vertices);
    block.first_triangle = surface;
    block.first_cap_triangle = cap;
    vertices += block.surface.vertices();
    on_edges += block.surface.edge_vertices();
    surface += block.triangles;
    cap += block.cap_triangles;
    draft.facts.cut_by_box = draft.facts.cut_by_box || block.surface.reaches_side();
  }
  if (on_edges == 0) refuse_empty(draft);
  if (vertices > std::numeric_limits<std::uint32_t>::max())
    throw InputError("cell", "is " + number_text(draft.options.cell) + ", which makes " +
                                 number_text(static_cast<double>(vertices), 3) +
                                 " vertices; at most 4.29e9 can be numbered");
  require_memory(bytes_for(static_cast<double>(draft.blocks.size()), static_cast<double>(vertices),
                           static_cast<double>(surface + cap)),
                 draft.options.max_memory, draft.grid.cell());
  draft.surface_triangles = surface;
  draft.mesh.points.resize(vertices);
  draft.mesh.normals.resize(vertices);
  draft.value.resize(vertices);
  draft.distance.resize(vertices);
  draft.mesh.triangles.resize(surface + cap);
}

/// Vertices of a block's cap: their corners, and the sums of the normals of the sides that these lie in.
struct CapVertices {
  Points points;
  std::vector<Vec3> normals;
};

CapVertices cap_vertices(const MeshDraft& draft, const MeshBlock& block) {
  CapVertices cap;
  const BlockPlace& place = block.place;
  for (const auto& local : block.surface.cap_corners()) {
    Vec3 normal = Vec3::Zero();
    for (std::size_t a = 0; a < 3; ++a) {
      if (place.at_low_side[a] && local[a] == 0) normal[static_cast<Eigen::Index>(a)] = -1.0;
      if (place.at_high_side[a] && local[a] == place.cells[a]) normal[static_cast<Eigen::Index>(a)] = 1.0;
    }
    cap.points.add(corner_point(draft.grid, place, local[0], local[1], local[2]));
    cap.normals.push_back(normal);
  }
  return cap;
}

/// A corner of the cap within a hundredth of a cell of the surface moves away from it by as much, in its side
/// of the box: vertices of the rim may lie on both sides of the corner, in line with it.
Vec3 off_the_rim(const MeshDraft& draft, const SurfacePoint& corner, const Vec3& normal) {
  Vec3 g = sense(draft.field.level()) * corner.gradient;
  for (int a = 0; a < 3; ++a)
    if (normal[a] != 0.0) g[a] = 0.0;
  const double slope = g.norm(), step = 0.01 * draft.grid.cell();
  if (!(slope > 0.0) || inside(draft.field.level(), corner.value) >= step * slope) return corner.at;
  return corner.at + step / slope * g;
}

void place_cap(MeshDraft& draft, std::size_t b) {
  MeshBlock& block = draft.blocks[b];
  const CapVertices cap = cap_vertices(draft, block);
  if (cap.normals.empty()) return;
  const BlockField field = draft.block_field(b);
  const std::vector<SurfacePoint> corners = measured(field, cap.points, block.evaluated);
  Points moved;
  for (std::size_t n = 0; n < corners.size(); ++n) moved.add(off_the_rim(draft, corners[n], cap.normals[n]));
  const std::vector<SurfacePoint> found = measured(field, moved, block.evaluated);
  const std::size_t first = block.first_vertex + block.surface.edge_vertices();
  for (std::size_t n = 0; n < found.size(); ++n) {
    draft.set_vertex(first + n, found[n]);
    draft.mesh.normals[first + n] = cap.normals[n].normalized();
    draft.distance[first + n] = std::numeric_limits<double>::quiet_NaN();
  }
}

void place_vertices(MeshDraft& draft, std::size_t b) {
  MeshBlock& block = draft.blocks[b];
  if (block.surface.edge_vertices() > 0) {
    const std::vector<SurfacePoint> points =
        project(draft.block_field(b), crossed_edges(block.surface), block.start, draft.options.newton_steps,
                block.evaluated);
    for (std::size_t n = 0; n < points.size(); ++n) draft.set_vertex(block.first_vertex + n, points[n]);
  }
  place_cap(draft, b);
}

void connect(MeshDraft& draft, std::size_t b) {
  const MeshBlock& block = draft.blocks[b];
  if (block.triangles + block.cap_triangles == 0) return;
  const Connector connector(draft.live, draft.blocks, b);
  const std::span<Triangle> all(draft.mesh.triangles);
  connector.write_surface(all.subspan(block.first_triangle, block.triangles));
  if (block.cap_triangles == 0) return;
  connector.write_cap(all.subspan(draft.surface_triangles + block.first_cap_triangle, block.cap_triangles));
}

void measure(MeshDraft& draft) {
  MeshFacts& facts = draft.facts;
  for (int a = 0; a < 3; ++a) facts.cells[a] = draft.grid.cells(a);
  facts.live_blocks = draft.live.crossed;
  std::size_t rim_edges = 0;
  for (const MeshBlock& block : draft.blocks) rim_edges += block.rim_edges;
  facts.vertices = draft.mesh.points.size();
  facts.triangles = draft.mesh.triangles.size();
  const auto [largest, mean] = summary_of(draft.distance);
  facts.largest_distance = largest;
  facts.mean_distance = mean;
  const auto [area, volume] = area_and_volume(draft.mesh, draft.grid.box().centre());
  facts.area = area;
  facts.volume = volume;
  // Every edge has two triangles, but those in the box's sides only one where the mesh is left open there.
  const std::size_t twice_edges = 3 * facts.triangles + (draft.cap() ? 0 : rim_edges);
  facts.euler_characteristic = static_cast<long>(facts.vertices) - static_cast<long>(twice_edges / 2) +
                               static_cast<long>(facts.triangles);
  facts.components = components_of(draft.mesh);
}

}  // namespace
}  // namespace detail

FieldMesh polygonize(const ScalarField& field, const MeshOptions& options, const Progress& progress) {
  using namespace detail;
  MeshDraft draft{field, grid_for(field, options), options, {}, {}, {}, {}, {}, 0, {}};
  draft.live = find_live_blocks(field, draft.grid, draft.cap(), options.max_memory, progress);
  draft.facts.cut_by_box = draft.live.inside_at_side;
  const std::size_t blocks = draft.live.blocks.size();
  draft.blocks.resize(blocks);
  for_each_in_batches(blocks, progress, 0.1, 0.4, "sampling", [&](std::size_t b) {
    draft.blocks[b] = sampled(draft, b);
    if (draft.blocks[b].surface.vertices() == 0) draft.live.blocks[b].model.reset();
  });
  number(draft);
  for_each_in_batches(blocks, progress, 0.4, 0.7, "projecting",
                      [&](std::size_t b) { place_vertices(draft, b); });
  for_each_in_batches(blocks, progress, 0.7, 0.8, "connecting", [&](std::size_t b) { connect(draft, b); });
  repair(draft);
  draft.facts.without_normal = fill_missing_normals(draft.mesh);
  measure(draft);
  if (options.columns) add_columns(draft, progress, 0.8, 1.0);
  for (const MeshBlock& block : draft.blocks) draft.facts.evaluated_points += block.evaluated;
  progress.at(1.0, "meshed");
  return {std::move(draft.mesh), draft.facts};
}

}  // namespace blendwright
