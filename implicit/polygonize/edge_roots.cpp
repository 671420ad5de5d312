#include "implicit/polygonize/edge_roots.hpp"

#include <algorithm>
#include <cmath>

namespace blendwright::detail {

void Points::reserve(std::size_t n) {
  for (auto* c : {&x, &y, &z}) c->reserve(n);
}
void Points::clear() {
  for (auto* c : {&x, &y, &z}) c->clear();
}
void Points::add(const Vec3& p) {
  x.push_back(p.x());
  y.push_back(p.y());
  z.push_back(p.z());
}

double linear_crossing(double a, double b) {
  double t = 0.5;
  if (std::isinf(a) != std::isinf(b)) {
    t = std::isinf(a) ? 1.0 : 0.0;
  } else if (!std::isinf(a)) {
    t = 0.5 * a / (0.5 * a - 0.5 * b);  // halves: the difference of huge values stays finite
  }
  return std::clamp(t, edge_margin, 1.0 - edge_margin);
}

Vec3 corner_point(const CellGrid& grid, const BlockPlace& place, int i, int j, int k) {
  const auto at = [&](int axis, int local) {
    return grid.at(axis, place.first[static_cast<std::size_t>(axis)] + static_cast<std::uint32_t>(local));
  };
  return {at(0, i), at(1, j), at(2, k)};
}

Points corner_points(const CellGrid& grid, const BlockPlace& place) {
  Points points;
  for (auto* c : {&points.x, &points.y, &points.z}) c->resize(place.corners());
  const auto row = static_cast<std::size_t>(place.cells[0] + 1);
  const std::span<const double> x = grid.axis(0).subspan(place.first[0], row);
  std::size_t n = 0;
  for (int k = 0; k <= place.cells[2]; ++k)
    for (int j = 0; j <= place.cells[1]; ++j, n += row) {
      const Vec3 start = corner_point(grid, place, 0, j, k);
      const auto at = static_cast<std::ptrdiff_t>(n);
      std::copy(x.begin(), x.end(), points.x.begin() + at);
      std::fill_n(points.y.begin() + at, row, start.y());
      std::fill_n(points.z.begin() + at, row, start.z());
    }
  return points;
}

Vec3 point_on_edge(const CellGrid& grid, const BlockPlace& place, const GridEdge& e, double t) {
  Vec3 p = corner_point(grid, place, e.i, e.j, e.k);
  const double end =
      corner_point(grid, place, e.i + (e.axis == 0), e.j + (e.axis == 1), e.k + (e.axis == 2))[e.axis];
  if (t == 1.0) {
    p[e.axis] = end;  // exactly: end points must have the signs of their corners
  } else {
    p[e.axis] += t * (end - p[e.axis]);
  }
  return p;
}

namespace {

/// A bracket [a, b] of the crossing with inside() at its ends.
struct Bracket {
  double a = 0.0, b = 1.0, fa = 0.0, fb = 0.0;
  int kept_b = 0;  ///< regula falsi steps in a row that kept b (> 0) or a (< 0)
  bool done = false;

  [[nodiscard]] double next(int step) const {
    const double middle = 0.5 * (a + b);
    if (step % 3 == 2 || std::isinf(fa) || std::isinf(fb)) return middle;
    const double weight_a = kept_b < -1 ? 0.5 : 1.0, weight_b = kept_b > 1 ? 0.5 : 1.0;
    const double t = a - weight_a * fa * (b - a) / (weight_b * fb - weight_a * fa);
    return t > a && t < b ? t : middle;
  }
  void narrow(double t, double f) {
    if ((f > 0.0) == (fa > 0.0)) {
      a = t;
      fa = f;
      kept_b = std::max(kept_b, 0) + 1;
    } else {
      b = t;
      fb = f;
      kept_b = std::min(kept_b, 0) - 1;
    }
    done = b - a <= 1e-10 || f == 0.0;
  }
  [[nodiscard]] double best() const { return std::abs(fa) < std::abs(fb) ? a : b; }
};

}  // namespace

std::vector<double> edge_roots(const CellGrid& grid, const ScalarField::Model& model, Level level,
                               const BlockPlace& place, std::span<const GridEdge> edges,
                               std::size_t& evaluated) {
  Points points;
  std::vector<double> values;
  const auto evaluate = [&] {
    values.resize(points.size());
    model.evaluate(Order::value, points.arrays(), values);
    evaluated += points.size();
    for (double& v : values) v = inside(level, v);
  };
  points.reserve(2 * edges.size());
  for (const double t : {0.0, 1.0})
    for (const GridEdge& e : edges) points.add(point_on_edge(grid, place, e, t));
  evaluate();
  std::vector<Bracket> brackets(edges.size());
  for (std::size_t n = 0; n < edges.size(); ++n) {
    brackets[n].fa = values[n];
    brackets[n].fb = values[edges.size() + n];
  }

  std::vector<std::size_t> active(edges.size());
  for (std::size_t n = 0; n < active.size(); ++n) active[n] = n;
  std::vector<double> parts;
  for (int step = 0; !active.empty(); ++step) {
    points.clear();
    parts.clear();
    for (const std::size_t n : active) {
      parts.push_back(brackets[n].next(step));
      points.add(point_on_edge(grid, place, edges[n], parts.back()));
    }
    evaluate();
    for (std::size_t m = 0; m < active.size(); ++m) brackets[active[m]].narrow(parts[m], values[m]);
    std::erase_if(active, [&](std::size_t n) { return brackets[n].done; });
  }

  std::vector<double> roots(edges.size());
  for (std::size_t n = 0; n < roots.size(); ++n)
    roots[n] = std::clamp(brackets[n].best(), edge_margin, 1.0 - edge_margin);
  return roots;
}

}  // namespace blendwright::detail
