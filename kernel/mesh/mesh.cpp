#include "kernel/mesh/mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"

namespace blendwright {
namespace {

/// The parameter grid: closed directions end one step before their seam.
struct Grid {
  SurfaceDomain domain;
  int nu = 1, nv = 1;         ///< cells
  int rows = 2, columns = 2;  ///< points
  Grid(const SurfaceDomain& d, int cells_u, int cells_v)
      : domain(d),
        nu(cells_u),
        nv(cells_v),
        rows(d.u_closed ? nu : nu + 1),
        columns(d.v_closed ? nv : nv + 1) {}
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  }
  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(i % rows) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(j % columns);
  }
  [[nodiscard]] UV at(int i, int j) const {
    return {domain.u.at(static_cast<double>(i) / nu), domain.v.at(static_cast<double>(j) / nv)};
  }
};

void require_cells(const char* name, int cells, bool closed) {
  const int least = closed ? 3 : 1;
  if (cells < least || cells > 30000)
    throw InputError(name,
                     "is " + number_text(cells) + " cells, must be from " + number_text(least) + " to 30000");
}

Vec3 unit_or_zero(const Vec3& x) {
  const double length = x.norm();
  return length > 0.0 && std::isfinite(length) ? Vec3(x / length) : Vec3(Vec3::Zero());
}

/// Which grid point stands for each: a row or column that shrinks to one point is represented by its first.
class Representatives {
 public:
  Representatives(const Grid& grid, const std::vector<Vec3>& points) : of_(grid.size()) {
    for (std::size_t k = 0; k < of_.size(); ++k) of_[k] = static_cast<std::uint32_t>(k);
    Vec3 low = points[0], high = points[0];
    for (const Vec3& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const double same = 1e-12 * (high - low).norm();  // rounding of a pole
    for (int i = 0; i < grid.rows; ++i)
      merge(points, same, grid.columns, [&](int j) { return grid.index(i, j); });
    for (int j = 0; j < grid.columns; ++j)
      merge(points, same, grid.rows, [&](int i) { return grid.index(i, j); });
  }
  [[nodiscard]] std::uint32_t operator[](std::size_t k) const { return of_[k]; }
  [[nodiscard]] bool stands_for_a_pole(std::size_t k) const { return poles_.size() > k && poles_[k]; }

 private:
  template <class Index>
  void merge(const std::vector<Vec3>& points, double same, int count, Index index) {
    const Vec3& first = points[index(0)];
    for (int k = 1; k < count; ++k)
      if (!((points[index(k)] - first).norm() <= same)) return;
    const std::uint32_t representative = of_[index(0)];
    for (int k = 0; k < count; ++k) of_[index(k)] = representative;
    poles_.resize(of_.size(), false);
    poles_[representative] = true;
  }
  std::vector<std::uint32_t> of_;
  std::vector<bool> poles_;
};

void add_triangle(TriMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (a != b && b != c && c != a) mesh.triangles.push_back({a, b, c});
}

/// A pole has no normal of its own: the mean of the triangles around it.
void set_pole_normals(TriMesh& mesh, const std::vector<bool>& is_pole) {
  std::vector<Vec3> sum(mesh.points.size(), Vec3::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 area = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    for (const std::uint32_t k : {a, b, c}) sum[k] += area;
  }
  for (std::size_t k = 0; k < sum.size(); ++k)
    if (is_pole[k]) mesh.normals[k] = unit_or_zero(sum[k]);
}

}  // namespace

TriMesh tessellate(const Surface& surface, int nu, int nv) {
  const SurfaceDomain domain = surface.domain();
  require_cells("nu", nu, domain.u_closed);
  require_cells("nv", nv, domain.v_closed);
  const Grid grid(domain, nu, nv);

  std::vector<Vec3> points(grid.size()), normals(grid.size());
  parallel_for(static_cast<std::size_t>(grid.rows), 4, [&](std::size_t begin, std::size_t end) {
    for (int i = static_cast<int>(begin); i < static_cast<int>(end); ++i)
      for (int j = 0; j < grid.columns; ++j) {
        const SurfaceJet jet = surface.jet(grid.at(i, j));
        points[grid.index(i, j)] = jet.S;
        normals[grid.index(i, j)] = unit_or_zero(jet.Su.cross(jet.Sv));
      }
  });

  const Representatives representative(grid, points);
  TriMesh mesh;
  mesh.columns = {{"u", "", 1, {}}, {"v", "", 1, {}}};
  std::vector<bool> is_pole;
  std::vector<std::uint32_t> number(grid.size(), 0);  // of the mesh point of each representative
  for (int i = 0; i < grid.rows; ++i)
    for (int j = 0; j < grid.columns; ++j) {
      const std::size_t k = grid.index(i, j);
      if (representative[k] != k) continue;
      number[k] = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.push_back(points[k]);
      mesh.normals.push_back(normals[k]);
      is_pole.push_back(representative.stands_for_a_pole(k));
      mesh.columns[0].values.push_back(grid.at(i, j).u);
      mesh.columns[1].values.push_back(grid.at(i, j).v);
    }

  const auto vertex = [&](int i, int j) { return number[representative[grid.index(i, j)]]; };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const std::uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                          d = vertex(i, j + 1);
      // The shorter diagonal; at a pole the only one that leaves a whole triangle.
      if ((mesh.points[a] - mesh.points[c]).squaredNorm() <=
          (mesh.points[b] - mesh.points[d]).squaredNorm()) {
        add_triangle(mesh, a, b, c);
        add_triangle(mesh, a, c, d);
      } else {
        add_triangle(mesh, a, b, d);
        add_triangle(mesh, b, c, d);
      }
    }
  set_pole_normals(mesh, is_pole);
  return mesh;
}

}  // namespace blendwright
