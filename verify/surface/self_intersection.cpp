// Self-intersection of the meshed blend: a tree of boxes over the cells of the grid, walked against itself.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "kernel/base/parallel_for.hpp"
#include "verify/surface/sample_grid.hpp"
#include "verify/surface/triangle_crossing.hpp"

namespace blendwright {
namespace detail {
namespace {

struct Box {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 hi = Vec3::Constant(-std::numeric_limits<double>::infinity());
  void add(const Vec3& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  void add(const Box& b) {
    lo = lo.cwiseMin(b.lo);
    hi = hi.cwiseMax(b.hi);
  }
  [[nodiscard]] bool apart(const Box& b) const {
    return lo.x() > b.hi.x() || b.lo.x() > hi.x() || lo.y() > b.hi.y() || b.lo.y() > hi.y() ||
           lo.z() > b.hi.z() || b.lo.z() > hi.z();
  }
};

// Cells [i0, i1) x [j0, j1). Cells near in parameters are near in space, so halving the index ranges is a
// good tree and needs no sorting.
struct Node {
  Box box;
  int i0, i1, j0, j1;
  std::int32_t left = -1, right = -1;
  [[nodiscard]] int cells() const { return (i1 - i0) * (j1 - j0); }
};

struct NodePair {
  std::int32_t a, b;
};

class CellTree {
 public:
  explicit CellTree(const SampleGrid& grid) : grid_(grid) {
    nodes_.reserve(2 * static_cast<std::size_t>(grid.nu()) * static_cast<std::size_t>(grid.nv()));
    build(0, grid.nu(), 0, grid.nv());
    wraps_u_ = grid.domain().u_closed || borders_meet_in_u();
    wraps_v_ = grid.domain().v_closed || borders_meet_in_v();
  }

  [[nodiscard]] SelfIntersectionReport search() const {
    const std::vector<NodePair> tasks = split(64);
    std::vector<SelfIntersectionReport> found(tasks.size());
    parallel_for(tasks.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) walk(tasks[k], found[k]);
    });
    SelfIntersectionReport report;
    for (const SelfIntersectionReport& f : found) {
      if (f.pairs > 0 && (report.pairs == 0 || f.where.value > report.where.value)) {
        report.where = f.where;
        report.other = f.other;
      }
      report.pairs += f.pairs;
    }
    return report;
  }

 private:
  [[nodiscard]] const Vec3& point(int i, int j) const { return grid_.point(i, j); }

  // A surface may close without saying so (a face read from a file).
  [[nodiscard]] bool borders_meet_in_u() const {
    double gap = 0.0;
    for (int j = 0; j <= grid_.nv(); ++j) gap = std::max(gap, (point(0, j) - point(grid_.nu(), j)).norm());
    return gap <= 1e-6 * grid_.size();
  }
  [[nodiscard]] bool borders_meet_in_v() const {
    double gap = 0.0;
    for (int i = 0; i <= grid_.nu(); ++i) gap = std::max(gap, (point(i, 0) - point(i, grid_.nv())).norm());
    return gap <= 1e-6 * grid_.size();
  }

  std::int32_t build(int i0, int i1, int j0, int j1) {
    const auto index = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back({{}, i0, i1, j0, j1});
    Node node = nodes_.back();
    if (node.cells() == 1) {
      for (const int i : {i0, i1})
        for (const int j : {j0, j1}) node.box.add(point(i, j));
    } else {
      const bool in_u = i1 - i0 > j1 - j0;
      const int middle = in_u ? (i0 + i1) / 2 : (j0 + j1) / 2;
      node.left = in_u ? build(i0, middle, j0, j1) : build(i0, i1, j0, middle);
      node.right = in_u ? build(middle, i1, j0, j1) : build(i0, i1, middle, j1);
      node.box.add(nodes_[static_cast<std::size_t>(node.left)].box);
      node.box.add(nodes_[static_cast<std::size_t>(node.right)].box);
    }
    nodes_[static_cast<std::size_t>(index)] = node;
    return index;
  }

  // The pairs below a pair; none when it can be dropped.
  template <class Push>
  void expand(NodePair pair, Push push) const {
    const Node &a = node(pair.a), &b = node(pair.b);
    if (pair.a == pair.b) {
      if (a.left < 0) return;
      push(NodePair{a.left, a.left});
      push(NodePair{a.right, a.right});
      push(NodePair{a.left, a.right});
    } else if (!a.box.apart(b.box)) {
      if (b.left < 0 || (a.left >= 0 && a.cells() >= b.cells())) {
        push(NodePair{a.left, pair.b});
        push(NodePair{a.right, pair.b});
      } else {
        push(NodePair{pair.a, b.left});
        push(NodePair{pair.a, b.right});
      }
    }
  }
  [[nodiscard]] bool leaves(NodePair pair) const {
    return pair.a != pair.b && node(pair.a).left < 0 && node(pair.b).left < 0;
  }
  [[nodiscard]] const Node& node(std::int32_t k) const { return nodes_[static_cast<std::size_t>(k)]; }

  // The top of the walk, breadth first: tasks that depend on the grid alone.
  [[nodiscard]] std::vector<NodePair> split(std::size_t wanted) const {
    std::vector<NodePair> level{{0, 0}};
    while (!level.empty() && level.size() < wanted) {
      std::vector<NodePair> below;
      bool grew = false;
      for (const NodePair pair : level) {
        if (leaves(pair)) {
          below.push_back(pair);
        } else {
          expand(pair, [&](NodePair p) { below.push_back(p); });
          grew = true;
        }
      }
      level = std::move(below);
      if (!grew) break;
    }
    return level;
  }

  void walk(NodePair top, SelfIntersectionReport& found) const {
    std::vector<NodePair> stack{top};
    while (!stack.empty()) {
      const NodePair pair = stack.back();
      stack.pop_back();
      if (leaves(pair))
        compare(node(pair.a), node(pair.b), found);
      else
        expand(pair, [&](NodePair p) { stack.push_back(p); });
    }
  }

  [[nodiscard]] static bool beside(int a, int b, int count, bool wraps) {
    const int d = std::abs(a - b);
    return d <= 1 || (wraps && d >= count - 1);
  }

  struct MeshTriangle {
    Triangle corners;
    std::array<UV, 3> uv;
  };
  [[nodiscard]] MeshTriangle triangle(const Node& cell, int half) const {
    const int i = cell.i0, j = cell.j0;
    const auto make = [&](int i1, int j1, int i2, int j2, int i3, int j3) -> MeshTriangle {
      return {{point(i1, j1), point(i2, j2), point(i3, j3)},
              {grid_.uv(i1, j1), grid_.uv(i2, j2), grid_.uv(i3, j3)}};
    };
    return half == 0 ? make(i, j, i + 1, j, i + 1, j + 1) : make(i, j, i + 1, j + 1, i, j + 1);
  }

  void compare(const Node& a, const Node& b, SelfIntersectionReport& found) const {
    if (beside(a.i0, b.i0, grid_.nu(), wraps_u_) && beside(a.j0, b.j0, grid_.nv(), wraps_v_)) return;
    if (a.box.apart(b.box)) return;
    for (const int half_a : {0, 1})
      for (const int half_b : {0, 1}) add(triangle(a, half_a), triangle(b, half_b), found);
  }

  void add(const MeshTriangle& a, const MeshTriangle& b, SelfIntersectionReport& found) const {
    // Rounding of positions is some 1e-16 of the size; heights over a thin triangle's plane lose a few digits
    // more.
    const std::optional<Crossing> c = crossing(a.corners, b.corners, 1e-12 * grid_.size());
    if (!c) return;
    if (++found.pairs > 1 && c->depth <= found.where.value) return;
    const MeshTriangle &edge = c->triangle == 0 ? a : b, &pierced = c->triangle == 0 ? b : a;
    const UV p = edge.uv[static_cast<std::size_t>(c->edge)],
             q = edge.uv[static_cast<std::size_t>((c->edge + 1) % 3)];
    found.where = {c->depth, {p.u + c->along * (q.u - p.u), p.v + c->along * (q.v - p.v)}, c->point};
    found.other = {(pierced.uv[0].u + pierced.uv[1].u + pierced.uv[2].u) / 3.0,
                   (pierced.uv[0].v + pierced.uv[1].v + pierced.uv[2].v) / 3.0};
  }

  const SampleGrid& grid_;
  std::vector<Node> nodes_;
  bool wraps_u_ = false, wraps_v_ = false;
};

}  // namespace

SelfIntersectionReport self_intersection(const SampleGrid& grid) {
  for (int j = 0; j <= grid.nv(); ++j)
    for (int i = 0; i <= grid.nu(); ++i)
      if (!grid.point(i, j).allFinite())
        return {0, {std::numeric_limits<double>::quiet_NaN(), grid.uv(i, j), grid.point(i, j)}, {}};
  return CellTree(grid).search();
}

}  // namespace detail

SelfIntersectionReport check_self_intersection(const Surface& blend, int nu, int nv) {
  return detail::self_intersection(detail::SampleGrid(blend, nu, nv));
}

}  // namespace blendwright
