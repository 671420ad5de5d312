#include "parametric/rolling_ball/ball_cover.hpp"

#include <algorithm>

namespace blendwright {
namespace {

constexpr std::size_t max_cells = 60000;

std::vector<Box> octants(const Box& box) {
  std::vector<Box> parts;
  const Vec3 m = box.centre();
  for (int k = 0; k < 8; ++k) {
    Box part;
    for (int i = 0; i < 3; ++i) {
      const bool upper = (k >> i) & 1;
      part.lo[i] = upper ? m[i] : box.lo[i];
      part.hi[i] = upper ? box.hi[i] : m[i];
    }
    parts.push_back(part);
  }
  return parts;
}

/// Boxes that may hold points of the surface, halved level by level.
std::vector<CoverCell> cover(const ScalarField& field, const Box& box, double size) {
  const double level = surface_value(field.level());
  std::vector<Box> boxes{box};
  while (!boxes.empty() && 0.5 * boxes.front().size().norm() > size && boxes.size() < max_cells) {
    std::vector<Box> finer;
    for (const Box& b : boxes)
      for (const Box& part : octants(b))
        if (field.range(part).contains(level)) finer.push_back(part);
    boxes = std::move(finer);
  }
  std::vector<CoverCell> cells;
  for (const Box& b : boxes) {
    CoverCell cell{b.centre(), 0.5 * b.size().norm()};
    const auto point = descended(field, cell.centre);
    if (point && (*point - cell.centre).norm() <= 2.0 * cell.radius) cell.point = point;
    cells.push_back(cell);
  }
  return cells;
}

struct Patch {
  Interval u, v;
  int depth = 0;
};

/// Ball around a patch, from 5 x 5 samples and a margin for what is between them.
CoverCell cell_of(const Surface& surface, const Patch& patch) {
  constexpr double margin = 1.25;
  CoverCell cell;
  cell.at = {patch.u.middle(), patch.v.middle()};
  cell.centre = surface.point(cell.at);
  cell.point = cell.centre;
  for (int i = 0; i < 5; ++i)
    for (int k = 0; k < 5; ++k)
      cell.radius = std::max(
          cell.radius, (surface.point({patch.u.at(i / 4.0), patch.v.at(k / 4.0)}) - cell.centre).norm());
  cell.radius *= margin;
  return cell;
}

double distance(const Box& box, const Vec3& p) { return (p - p.cwiseMax(box.lo).cwiseMin(box.hi)).norm(); }

/// Of both directions the one in which the patch is longer is halved.
std::array<Patch, 2> halves(const Surface& surface, const Patch& p) {
  const SurfaceJet j = surface.jet({p.u.middle(), p.v.middle()});
  const bool along_u = j.Su.norm() * p.u.length() >= j.Sv.norm() * p.v.length();
  const Interval& t = along_u ? p.u : p.v;
  const Interval lower{t.lo, t.middle()}, upper{t.middle(), t.hi};
  if (along_u) return {Patch{lower, p.v, p.depth + 1}, Patch{upper, p.v, p.depth + 1}};
  return {Patch{p.u, lower, p.depth + 1}, Patch{p.u, upper, p.depth + 1}};
}

std::vector<CoverCell> cover(const Surface& surface, const Box& box, double size) {
  constexpr int first = 6,
                deepest = 30;  // 6 x 6 patches to begin with: no symmetry hides what is between samples
  const SurfaceDomain domain = surface.domain();
  std::vector<Patch> open;
  for (int i = 0; i < first; ++i)
    for (int k = 0; k < first; ++k)
      open.push_back({{domain.u.at(double(i) / first), domain.u.at(double(i + 1) / first)},
                      {domain.v.at(double(k) / first), domain.v.at(double(k + 1) / first)},
                      0});
  std::vector<CoverCell> cells;
  for (std::size_t k = 0; k < open.size(); ++k) {
    const Patch patch = open[k];
    const CoverCell cell = cell_of(surface, patch);
    if (distance(box, cell.centre) > cell.radius) continue;
    if (cell.radius <= size || patch.depth >= deepest || open.size() > 2 * max_cells) {
      cells.push_back(cell);
    } else {
      for (const Patch& half : halves(surface, patch)) open.push_back(half);
    }
  }
  return cells;
}

}  // namespace

std::vector<CoverCell> cover(const BallPrimary& primary, const Box& box, double size) {
  return primary.field() ? cover(*primary.field(), box, size) : cover(*primary.surface(), box, size);
}

}  // namespace blendwright
