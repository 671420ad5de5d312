#include <algorithm>

#include "implicit/polygonize/mesh_draft.hpp"
#include "implicit/polygonize/mesh_flips.hpp"
#include "kernel/base/parallel_for.hpp"

namespace blendwright::detail {
namespace {

struct Spoilt {
  std::vector<std::size_t> flat, turned;  ///< triangles
  [[nodiscard]] bool none() const { return flat.empty() && turned.empty(); }
  [[nodiscard]] std::vector<std::size_t> all() const {
    std::vector<std::size_t> faces = flat;
    faces.insert(faces.end(), turned.begin(), turned.end());
    return faces;
  }
};

/// The outward normal of the side of the box that a face of the cap lies in.
Vec3 side_normal(const Box& box, const Vec3& a, const Vec3& b, const Vec3& c) {
  Vec3 n = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    if (a[k] != b[k] || b[k] != c[k]) continue;
    if (a[k] == box.lo[k]) n[k] = -1.0;
    if (a[k] == box.hi[k]) n[k] = 1.0;
  }
  return n;
}

enum class Look { good, turned, flat };

/// `n`: the number of the face, which tells the cap from the surface.
Look look_of(const MeshDraft& draft, std::size_t n, const Triangle& vertices) {
  const TriMesh& mesh = draft.mesh;
  const auto [i, j, k] = vertices;
  const Vec3 &a = mesh.points[i], &b = mesh.points[j], &c = mesh.points[k];
  const Vec3 twice_area = (b - a).cross(c - a);
  const double cell = draft.grid.cell();
  if (!(0.5 * twice_area.norm() >= 1e-9 * cell * cell)) return Look::flat;
  if (n >= draft.surface_triangles)
    return twice_area.dot(side_normal(draft.grid.box(), a, b, c)) > 0.0 ? Look::good : Look::turned;
  const Vec3 outward = mesh.normals[i] + mesh.normals[j] + mesh.normals[k];
  return twice_area.dot(outward) < 0.0 ? Look::turned : Look::good;
}

Spoilt spoilt_faces(const MeshDraft& draft) {
  constexpr std::size_t chunk = 8192;
  const std::size_t count = draft.mesh.triangles.size();
  std::vector<Spoilt> partial((count + chunk - 1) / chunk);
  parallel_for(count, chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const Look look = look_of(draft, n, draft.mesh.triangles[n]);
      if (look == Look::flat) partial[begin / chunk].flat.push_back(n);
      if (look == Look::turned) partial[begin / chunk].turned.push_back(n);
    }
  });
  Spoilt all;
  for (const Spoilt& p : partial) {
    all.flat.insert(all.flat.end(), p.flat.begin(), p.flat.end());
    all.turned.insert(all.turned.end(), p.turned.begin(), p.turned.end());
  }
  return all;
}

std::vector<std::uint32_t> vertices_of(const TriMesh& mesh, const std::vector<std::size_t>& triangles) {
  std::vector<std::uint32_t> vertices;
  for (const std::size_t n : triangles)
    vertices.insert(vertices.end(), mesh.triangles[n].begin(), mesh.triangles[n].end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

enum class Place { crossing, start };

/// Puts vertices (numbers of one block, rising) on their edges.
void put_on_edges(MeshDraft& draft, std::size_t b, std::span<const std::uint32_t> vertices, Place where) {
  MeshBlock& block = draft.blocks[b];
  const std::vector<GridEdge> own = crossed_edges(block.surface);
  std::vector<GridEdge> edges;
  std::vector<std::uint32_t> moved;
  std::vector<double> starts;
  for (const std::uint32_t v : vertices) {
    const std::size_t local = v - block.first_vertex;
    if (local >= own.size()) continue;  // corners of the cap do not move
    moved.push_back(v);
    edges.push_back(own[local]);
    starts.push_back(block.start[local]);
  }
  const BlockField field = draft.block_field(b);
  const std::vector<SurfacePoint> points = where == Place::crossing
                                               ? crossings(field, edges, block.evaluated)
                                               : project(field, edges, starts, 0, block.evaluated);
  for (std::size_t n = 0; n < moved.size(); ++n)
    if (where == Place::start || reached(field, points[n])) draft.set_vertex(moved[n], points[n]);
}

void put_on_edges(MeshDraft& draft, const std::vector<std::uint32_t>& vertices, Place where) {
  struct Group {
    std::size_t block, first, last;
  };
  std::vector<Group> groups;
  for (std::size_t first = 0; first < vertices.size();) {
    const auto above =
        std::upper_bound(draft.blocks.begin(), draft.blocks.end(), vertices[first],
                         [](std::uint32_t v, const MeshBlock& block) { return v < block.first_vertex; });
    const auto end = above == draft.blocks.end()
                         ? vertices.end()
                         : std::lower_bound(vertices.begin(), vertices.end(), above->first_vertex);
    const auto last = static_cast<std::size_t>(end - vertices.begin());
    groups.push_back({static_cast<std::size_t>(above - draft.blocks.begin()) - 1, first, last});
    first = last;
  }
  parallel_for(groups.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g)
      put_on_edges(draft, groups[g].block,
                   std::span(vertices).subspan(groups[g].first, groups[g].last - groups[g].first), where);
  });
}

void flip(MeshDraft& draft, const Spoilt& spoilt) {
  flip_unacceptable_faces(
      draft.mesh.triangles, draft.mesh.points.size(), spoilt.all(),
      [&](std::size_t n, const Triangle& vertices) { return look_of(draft, n, vertices) == Look::good; });
}

}  // namespace

void repair(MeshDraft& draft) {
  Spoilt spoilt = spoilt_faces(draft);
  if (draft.options.newton_steps > 0 && !spoilt.none()) {
    flip(draft, spoilt);
    spoilt = spoilt_faces(draft);
  }
  if (draft.options.newton_steps > 0 && !spoilt.none()) {
    put_on_edges(draft, vertices_of(draft.mesh, spoilt.all()), Place::crossing);
    flip(draft, spoilt_faces(draft));
    spoilt = spoilt_faces(draft);
  }
  while (draft.options.newton_steps > 0 && !spoilt.flat.empty()) {
    put_on_edges(draft, vertices_of(draft.mesh, spoilt.flat), Place::start);
    Spoilt again = spoilt_faces(draft);
    const bool same = again.flat == spoilt.flat;
    spoilt = std::move(again);
    if (same) break;
  }
  draft.facts.turned_faces = spoilt.turned.size();
}

}  // namespace blendwright::detail
