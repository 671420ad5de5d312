#include "kernel/mesh/mesh_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

using Edge = std::array<std::uint32_t, 2>;

Edge sorted(std::uint32_t a, std::uint32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

/// A box of the tree. Children of an inner one follow each other, `first` is the left; a leaf has `count`
/// triangles from `first` on.
struct TreeBox {
  Vec3 lo, hi;
  std::uint32_t first = 0, count = 0;
  /// Squared distance, less what rounding may have added to it.
  [[nodiscard]] double least_squared(const Vec3& q) const {
    const Vec3 out = (lo - q).cwiseMax(q - hi).cwiseMax(0.0);
    return out.squaredNorm() * (1.0 - 8.0 * std::numeric_limits<double>::epsilon());
  }
};

constexpr std::uint32_t leaf = 4;

/// Halves at the median of the triangles' middles along the longest side of the box of these. A tree of
/// nearest-neighbour queries: Boost's R-tree sorts all that it has seen at every step, 100 times as slow.
class TreeMaker {
 public:
  TreeMaker(const TriMesh& mesh, std::vector<std::uint32_t>& order) : mesh_(mesh), order_(order) {
    order_.resize(mesh.triangles.size());
    std::iota(order_.begin(), order_.end(), 0u);
    boxes_.resize(1);
    split(0, 0, static_cast<std::uint32_t>(order_.size()));
  }
  [[nodiscard]] std::vector<TreeBox> take() { return std::move(boxes_); }

 private:
  [[nodiscard]] Vec3 middle(std::uint32_t t) const {
    Vec3 sum = Vec3::Zero();
    for (const std::uint32_t k : mesh_.triangles[t]) sum += mesh_.points[k] / 3.0;
    return sum;
  }
  void split(std::size_t at, std::uint32_t begin, std::uint32_t end) {
    TreeBox box;
    box.lo = Vec3::Constant(std::numeric_limits<double>::infinity());
    box.hi = -box.lo;
    Vec3 low = box.lo, high = box.hi;
    for (std::uint32_t i = begin; i < end; ++i) {
      for (const std::uint32_t k : mesh_.triangles[order_[i]]) {
        box.lo = box.lo.cwiseMin(mesh_.points[k]);
        box.hi = box.hi.cwiseMax(mesh_.points[k]);
      }
      const Vec3 m = middle(order_[i]);
      low = low.cwiseMin(m), high = high.cwiseMax(m);
    }
    if (end - begin <= leaf) {
      box.first = begin, box.count = end - begin;
      boxes_[at] = box;
      return;
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    const std::uint32_t half = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double x = middle(a)[axis], y = middle(b)[axis];
                       return x != y ? x < y : a < b;
                     });
    const std::size_t children = boxes_.size();
    boxes_.resize(children + 2);
    box.first = static_cast<std::uint32_t>(children);
    boxes_[at] = box;
    split(children, begin, half);
    split(children + 1, half, end);
  }
  const TriMesh& mesh_;
  std::vector<std::uint32_t>& order_;
  std::vector<TreeBox> boxes_;
};

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
  std::vector<TreeBox> boxes;                          ///< the first is the whole
  std::vector<std::uint32_t> order;                    ///< the triangles, leaf by leaf
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
  impl->boxes = TreeMaker(impl->mesh, impl->order).take();
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
  std::array<std::pair<std::uint32_t, double>, 128> open;  // halving 2^32 triangles needs half of that
  std::size_t count = 0;
  open[count++] = {0, impl_->boxes[0].least_squared(q)};
  while (count > 0) {
    const auto [at, least] = open[--count];
    if (least > best.distance * best.distance) continue;
    const TreeBox& box = impl_->boxes[at];
    if (box.count == 0) {
      const double left = impl_->boxes[box.first].least_squared(q),
                   right = impl_->boxes[box.first + 1].least_squared(q);
      const std::uint32_t nearer = left <= right ? 0 : 1;
      open[count++] = {box.first + 1 - nearer, std::max(left, right)};
      open[count++] = {box.first + nearer, std::min(left, right)};
      continue;
    }
    for (std::uint32_t i = box.first; i < box.first + box.count; ++i) {
      const MeshFoot foot = closest_on(impl_->order[i], q);
      // Of equally near triangles always the first.
      if (foot.distance < best.distance || (foot.distance == best.distance && foot.triangle < best.triangle))
        best = foot;
    }
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
