#include "implicit/polygonize/projection.hpp"

#include <algorithm>
#include <cmath>

namespace blendwright::detail {
namespace {

constexpr int most_halvings = 4, most_further_steps = 8;
constexpr double on_surface = 1e-7;  ///< cells; what counts as reached
constexpr double exact = 1e-11;      ///< cells; no step is worth its cost below this

struct Mover {
  Vec3 start = Vec3::Zero();
  SurfacePoint now;
  std::array<bool, 3> fixed{};  ///< coordinates that a side of the box holds
  int steps = 0, halvings = 0;
  double damping = 1.0;
};

/// Which coordinates of the points of an edge lie in a side of the grid's box.
std::array<bool, 3> held(const BlockPlace& place, const GridEdge& e) {
  const std::array local{e.i, e.j, e.k};
  std::array<bool, 3> result{};
  for (std::size_t a = 0; a < 3; ++a)
    result[a] = static_cast<int>(a) != e.axis && ((place.at_low_side[a] && local[a] == 0) ||
                                                  (place.at_high_side[a] && local[a] == place.cells[a]));
  return result;
}

class Newton {
 public:
  Newton(const BlockField& block, int steps) : block_(block), steps_(steps) {}

  [[nodiscard]] bool active(const Mover& m) const {
    if (m.steps >= steps_ || m.halvings >= most_halvings) return false;
    const double phi = std::abs(inside(block_.level, m.now.value)), slope = free_gradient(m).norm();
    return std::isfinite(phi) && slope > 0.0 && std::isfinite(slope) &&
           phi > exact * block_.grid.cell() * slope;
  }
  /// Equation (1) for the mover's present damping, kept near its start and in the box.
  [[nodiscard]] Vec3 candidate(const Mover& m) const {
    const Vec3 g = free_gradient(m);
    const double slope = g.norm();
    const double distance = std::min(std::abs(inside(block_.level, m.now.value)) / slope, block_.grid.cell());
    const double way = inside(block_.level, m.now.value) > 0.0 ? -1.0 : 1.0;
    const Vec3 moved = m.now.at + (way * m.damping * distance) * (g / slope);
    const Vec3 offset = moved - m.start;
    const double radius = 0.5 * block_.grid.cell() * (1.0 - 1e-12), length = offset.norm();
    const Vec3 near = length > radius ? Vec3(m.start + (radius / length) * offset) : moved;
    const Box& box = block_.grid.box();
    return near.cwiseMax(box.lo).cwiseMin(box.hi);
  }
  void judge(Mover& m, const SurfacePoint& found) const {
    if (std::abs(inside(block_.level, found.value)) < std::abs(inside(block_.level, m.now.value))) {
      m.now = found;
      ++m.steps;
      m.damping = 1.0;
    } else {
      ++m.halvings;
      m.damping *= 0.5;
    }
  }

 private:
  /// The gradient of phi along the free coordinates.
  [[nodiscard]] Vec3 free_gradient(const Mover& m) const {
    Vec3 g = sense(block_.level) * m.now.gradient;
    for (int a = 0; a < 3; ++a)
      if (m.fixed[static_cast<std::size_t>(a)]) g[a] = 0.0;
    return g;
  }
  const BlockField& block_;
  int steps_;
};

std::vector<Mover> movers(const BlockField& block, std::span<const GridEdge> edges, std::span<const double> t,
                          std::size_t& evaluated) {
  Points points;
  points.reserve(edges.size());
  for (std::size_t n = 0; n < edges.size(); ++n)
    points.add(point_on_edge(block.grid, block.place, edges[n], t[n]));
  const std::vector<SurfacePoint> starts = measured(block, points, evaluated);
  std::vector<Mover> result(edges.size());
  for (std::size_t n = 0; n < edges.size(); ++n) {
    result[n].start = starts[n].at;
    result[n].now = starts[n];
    result[n].fixed = held(block.place, edges[n]);
  }
  return result;
}

/// Moves all that are active until none is.
void descend(const BlockField& block, int steps, std::vector<Mover>& all, std::size_t& evaluated) {
  const Newton newton(block, steps);
  std::vector<std::size_t> active;
  for (std::size_t n = 0; n < all.size(); ++n)
    if (newton.active(all[n])) active.push_back(n);
  Points points;
  while (!active.empty()) {
    points.clear();
    for (const std::size_t n : active) points.add(newton.candidate(all[n]));
    const std::vector<SurfacePoint> found = measured(block, points, evaluated);
    for (std::size_t m = 0; m < active.size(); ++m) newton.judge(all[active[m]], found[m]);
    std::erase_if(active, [&](std::size_t n) { return !newton.active(all[n]); });
  }
}

/// Vertices that Newton left beside the surface take the crossings of their edges.
void take_crossings(const BlockField& block, std::span<const GridEdge> edges, std::vector<Mover>& all,
                    std::size_t& evaluated) {
  std::vector<std::size_t> left;
  std::vector<GridEdge> left_edges;
  for (std::size_t n = 0; n < all.size(); ++n)
    if (!reached(block, all[n].now)) {
      left.push_back(n);
      left_edges.push_back(edges[n]);
    }
  if (left.empty()) return;
  const std::vector<SurfacePoint> found = crossings(block, left_edges, evaluated);
  for (std::size_t m = 0; m < left.size(); ++m) {
    SurfacePoint& now = all[left[m]].now;
    if (std::abs(inside(block.level, found[m].value)) < std::abs(inside(block.level, now.value)))
      now = found[m];
  }
}

}  // namespace

bool reached(const BlockField& block, const SurfacePoint& p) {
  const double phi = std::abs(inside(block.level, p.value));
  return phi <= on_surface * block.grid.cell() * p.gradient.norm();
}

std::vector<SurfacePoint> measured(const BlockField& block, const Points& points, std::size_t& evaluated) {
  const std::size_t n = points.size();
  std::vector<double> out(components(Order::gradient) * n);
  block.model.evaluate(Order::gradient, points.arrays(), out);
  evaluated += n;
  std::vector<SurfacePoint> result(n);
  for (std::size_t i = 0; i < n; ++i)
    result[i] = {points[i], Vec3(out[n + i], out[2 * n + i], out[3 * n + i]), out[i]};
  return result;
}

std::vector<SurfacePoint> crossings(const BlockField& block, std::span<const GridEdge> edges,
                                    std::size_t& evaluated) {
  const std::vector<double> t =
      edge_roots(block.grid, block.model, block.level, block.place, edges, evaluated);
  Points points;
  points.reserve(edges.size());
  for (std::size_t n = 0; n < edges.size(); ++n)
    points.add(point_on_edge(block.grid, block.place, edges[n], t[n]));
  return measured(block, points, evaluated);
}

std::vector<SurfacePoint> project(const BlockField& block, std::span<const GridEdge> edges,
                                  std::span<const double> t, int newton_steps, std::size_t& evaluated) {
  std::vector<Mover> all = movers(block, edges, t, evaluated);
  if (newton_steps > 0) {
    descend(block, newton_steps, all, evaluated);
    take_crossings(block, edges, all, evaluated);
    for (Mover& m : all) {  // crossings at the margins of their edges, and what has none
      m.steps = m.halvings = reached(block, m.now) ? most_further_steps : 0;
      m.damping = 1.0;
    }
    descend(block, most_further_steps, all, evaluated);
  }
  std::vector<SurfacePoint> result(all.size());
  for (std::size_t n = 0; n < all.size(); ++n) result[n] = all[n].now;
  return result;
}

}  // namespace blendwright::detail
