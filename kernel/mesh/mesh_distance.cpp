#define BOOST_ALLOW_DEPRECATED_HEADERS  // some of Boost.Geometry's own headers include others that say so
#include "kernel/mesh/mesh_distance.hpp"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <cmath>
#include <limits>
#include <map>

#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

namespace bg = boost::geometry;
using Corner = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<Corner>;
using Entry = std::pair<TreeBox, std::uint32_t>;
using Tree = bg::index::rtree<Entry, bg::index::rstar<8>>;
using Edge = std::array<std::uint32_t, 2>;

Edge sorted(std::uint32_t a, std::uint32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

/// Squared distance to a box, less what rounding may have added to it.
double least_squared(const TreeBox& box, const Vec3& q) {
  const Vec3 lo(bg::get<0>(box.min_corner()), bg::get<1>(box.min_corner()), bg::get<2>(box.min_corner()));
  const Vec3 hi(bg::get<0>(box.max_corner()), bg::get<1>(box.max_corner()), bg::get<2>(box.max_corner()));
  const Vec3 out = (lo - q).cwiseMax(q - hi).cwiseMax(0.0);
  return out.squaredNorm() * (1.0 - 8.0 * std::numeric_limits<double>::epsilon());
}

/// On the segment a + t (b - a): the weight t.
double on_segment(const Vec3& a, const Vec3& b, const Vec3& q) {
  const double squared = (b - a).squaredNorm();
  return squared > 0.0 ? std::clamp((q - a).dot(b - a) / squared, 0.0, 1.0) : 0.0;
}

/// The triangle at a corner is as wide as this angle.
double angle_at(const Vec3& corner, const Vec3& a, const Vec3& b) {
  return std::atan2((a - corner).cross(b - corner).norm(), (a - corner).dot(b - corner));
}

}  // namespace

struct MeshTree::Impl {
  TriMesh mesh;
  Tree tree;
  std::map<Edge, std::array<std::uint32_t, 2>> edges;  ///< the triangles; the second as the first at a border
  std::vector<Vec3> corner_normals;
  bool oriented = true;
  double size = 0.0;
};

MeshFoot closest_point(const std::array<Vec3, 3>& t, const Vec3& q) {
  MeshFoot best;
  best.distance = std::numeric_limits<double>::infinity();
  const auto consider = [&](const std::array<double, 3>& weights) {
    const Vec3 p = weights[0] * t[0] + weights[1] * t[1] + weights[2] * t[2];
    const double distance = (q - p).norm();
    if (distance < best.distance) best = {0, p, distance, weights};
  };
  // The foot in the plane, where it lies within the triangle; else it is on a side.
  const Vec3 a = t[1] - t[0], b = t[2] - t[0], r = q - t[0], n = a.cross(b);
  const double nn = n.squaredNorm();
  if (nn > 0.0) {
    const double v = r.cross(b).dot(n) / nn, w = a.cross(r).dot(n) / nn;
    if (v >= 0.0 && w >= 0.0 && v + w <= 1.0) {
      consider({1.0 - v - w, v, w});
      // In the plane's own direction the height is exact where the difference of points is not.
      best.distance = std::min(best.distance, std::max(std::abs(r.dot(n)) / std::sqrt(nn), 0.0));
      return best;
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const double s = on_segment(t[k], t[next], q);
    std::array<double, 3> weights{};
    weights[k] = 1.0 - s, weights[next] = s;
    consider(weights);
  }
  return best;
}

MeshTree::MeshTree(TriMesh mesh) {
  auto impl = std::make_shared<Impl>();
  impl->mesh = std::move(mesh);
  const std::vector<Vec3>& points = impl->mesh.points;
  if (impl->mesh.triangles.empty()) throw InputError("", "has no triangles, must have some");
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite())
      throw InputError("point " + std::to_string(i), "is not finite, must be numbers");
  std::vector<Entry> entries;
  entries.reserve(impl->mesh.triangles.size());
  impl->corner_normals.assign(points.size(), Vec3::Zero());
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  std::map<Edge, int> uses;  // how often an edge is run through from its lower to its higher point, less back
  for (std::size_t i = 0; i < impl->mesh.triangles.size(); ++i) {
    const auto& t = impl->mesh.triangles[i];
    for (const std::uint32_t k : t)
      if (k >= points.size())
        throw InputError(
            "triangle " + std::to_string(i),
            "names point " + std::to_string(k) + ", must be below " + std::to_string(points.size()));
    const auto index = static_cast<std::uint32_t>(i);
    const Vec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    const Vec3 lo = a.cwiseMin(b).cwiseMin(c), hi = a.cwiseMax(b).cwiseMax(c);
    low = low.cwiseMin(lo), high = high.cwiseMax(hi);
    entries.emplace_back(TreeBox(Corner(lo.x(), lo.y(), lo.z()), Corner(hi.x(), hi.y(), hi.z())), index);
    const Vec3 n = (b - a).cross(c - a).normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t here = t[k], next = t[(k + 1) % 3], last = t[(k + 2) % 3];
      if (n.allFinite()) impl->corner_normals[here] += angle_at(points[here], points[next], points[last]) * n;
      const auto [edge, fresh] = impl->edges.try_emplace(sorted(here, next), std::array{index, index});
      if (!fresh && edge->second[0] == edge->second[1])
        edge->second[1] = index;
      else if (!fresh)
        impl->oriented = false;  // a third triangle
      int& turns = uses[sorted(here, next)];
      turns += here < next ? 1 : -1;
      if (std::abs(turns) > 1) impl->oriented = false;
    }
  }
  impl->tree = Tree(entries);  // packed: all entries at once
  impl->size = (high - low).norm();
  impl_ = std::move(impl);
}

const TriMesh& MeshTree::mesh() const { return impl_->mesh; }
bool MeshTree::oriented() const { return impl_->oriented; }
double MeshTree::size() const { return impl_->size; }

std::array<Vec3, 3> MeshTree::corners(std::uint32_t triangle) const {
  const auto& t = impl_->mesh.triangles[triangle];
  return {impl_->mesh.points[t[0]], impl_->mesh.points[t[1]], impl_->mesh.points[t[2]]};
}

MeshFoot MeshTree::closest_on(std::uint32_t triangle, const Vec3& q) const {
  MeshFoot foot = closest_point(corners(triangle), q);
  foot.triangle = triangle;
  return foot;
}

MeshFoot MeshTree::closest(const Vec3& q) const {
  MeshFoot best;
  best.distance = std::numeric_limits<double>::infinity();
  const Corner at(q.x(), q.y(), q.z());
  const auto count = static_cast<unsigned>(impl_->tree.size());
  // Boxes come in the order of their distance: none behind one that is further than the best holds a better.
  for (auto entry = impl_->tree.qbegin(bg::index::nearest(at, count)); entry != impl_->tree.qend(); ++entry) {
    if (least_squared(entry->first, q) > best.distance * best.distance) break;
    const MeshFoot foot = closest_on(entry->second, q);
    // Of equally near triangles always the same one, whatever the order of their boxes.
    if (foot.distance < best.distance || (foot.distance == best.distance && foot.triangle < best.triangle))
      best = foot;
  }
  return best;
}

bool MeshTree::on_border(const MeshFoot& foot) const {
  const auto& t = impl_->mesh.triangles[foot.triangle];
  for (std::size_t k = 0; k < 3; ++k) {
    if (foot.weights[(k + 2) % 3] != 0.0) continue;
    const auto& [first, second] = impl_->edges.at(sorted(t[k], t[(k + 1) % 3]));
    if (first == second) return true;
  }
  return false;
}

Vec3 MeshTree::side_normal(const MeshFoot& foot) const {
  const auto normal = [&](std::uint32_t triangle) -> Vec3 {
    const auto [a, b, c] = corners(triangle);
    const Vec3 n = (b - a).cross(c - a);
    return n.isZero(0.0) ? n : Vec3(n.normalized());
  };
  const auto& t = impl_->mesh.triangles[foot.triangle];
  for (std::size_t k = 0; k < 3; ++k)
    if (foot.weights[k] == 1.0) return impl_->corner_normals[t[k]];
  for (std::size_t k = 0; k < 3; ++k)
    if (foot.weights[(k + 2) % 3] == 0.0) {
      const auto& [first, second] = impl_->edges.at(sorted(t[k], t[(k + 1) % 3]));
      return normal(first) + normal(second);
    }
  return normal(foot.triangle);
}

}  // namespace blendwright
