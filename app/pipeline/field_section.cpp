#include "app/pipeline/field_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "kernel/base/parallel_for.hpp"

namespace blendwright {
namespace {

/// Corners of the cells, then their middles.
TriMesh grid_of(const Box& box, const SectionPlane& plane, std::size_t cells) {
  const int a = (plane.k + 1) % 3, b = (plane.k + 2) % 3;
  const Vec3 size = box.size();
  const double cell = std::max(size[a], size[b]) / static_cast<double>(cells);
  const auto count = [&](int axis) {
    return std::max<std::uint32_t>(1, static_cast<std::uint32_t>(std::lround(size[axis] / cell)));
  };
  const std::uint32_t na = count(a), nb = count(b);
  TriMesh mesh;
  const auto add = [&](double i, double j) {
    Vec3& p = mesh.points.emplace_back();
    p[plane.k] = plane.at;
    p[a] = box.lo[a] + size[a] * i / na;
    p[b] = box.lo[b] + size[b] * j / nb;
  };
  for (std::uint32_t i = 0; i <= na; ++i)
    for (std::uint32_t j = 0; j <= nb; ++j) add(i, j);
  for (std::uint32_t i = 0; i < na; ++i)
    for (std::uint32_t j = 0; j < nb; ++j) {
      const auto middle = static_cast<std::uint32_t>(mesh.points.size());
      add(i + 0.5, j + 0.5);
      const std::uint32_t c = i * (nb + 1) + j, d = c + nb + 1;
      for (const auto& [p, q] : {std::pair(c, d), {d, d + 1}, {d + 1, c + 1}, {c + 1, c}})
        mesh.triangles.push_back({p, q, middle});
    }
  return mesh;
}

/// Where the values change sign along the edges of the triangles, from end to end.
class ZeroLines {
 public:
  ZeroLines(const TriMesh& mesh, const std::vector<double>& values) : mesh_(mesh), values_(values) {
    for (const auto& t : mesh.triangles) {
      std::vector<Edge> crossed;
      for (std::size_t i = 0; i < 3; ++i) {
        const double x = values[t[i]], y = values[t[(i + 1) % 3]];
        if (std::isfinite(x) && std::isfinite(y) && (x >= 0.0) != (y >= 0.0))
          crossed.push_back(std::minmax(t[i], t[(i + 1) % 3]));
      }
      if (crossed.size() != 2) continue;
      next_[crossed[0]].push_back(crossed[1]);
      next_[crossed[1]].push_back(crossed[0]);
    }
  }

  std::vector<PolyLine> lines() {
    std::vector<PolyLine> found;
    for (const bool open : {true, false})
      for (const auto& [edge, neighbours] : next_)
        if (!used_.contains(edge) && (!open || neighbours.size() == 1)) found.push_back(line_from(edge));
    return found;
  }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  PolyLine line_from(const Edge& first) {
    PolyLine line{"surface", {}, next_[first].size() == 2, {}};
    for (const Edge* edge = &first; edge;) {
      used_.insert(*edge);
      const double w = values_[edge->first] / (values_[edge->first] - values_[edge->second]);
      const Vec3 &a = mesh_.points[edge->first], &b = mesh_.points[edge->second];
      line.points.push_back(a + w * (b - a));
      const Edge* following = nullptr;
      for (const Edge& n : next_[*edge])
        if (!used_.contains(n)) following = &n;
      edge = following;
    }
    return line;
  }

  const TriMesh& mesh_;
  const std::vector<double>& values_;
  std::map<Edge, std::vector<Edge>> next_;
  std::set<Edge> used_;
};

}  // namespace

FieldSection field_section(const ScalarField& field, const Box& box, const SectionPlane& plane,
                           std::size_t cells, const Progress& progress) {
  FieldSection section;
  section.mesh = grid_of(box, plane, cells);
  const std::vector<Vec3>& points = section.mesh.points;
  std::vector<double> values(points.size());
  progress.at(0.0, "evaluating the field");
  parallel_for(points.size(), 4096, [&](std::size_t begin, std::size_t end) {
    const FieldValues batch = field.evaluate(Order::value, std::span(points).subspan(begin, end - begin));
    for (std::size_t i = begin; i < end; ++i) {
      const double x = inside(field.level(), batch.value(i - begin));
      values[i] = std::isfinite(x) ? x : std::numeric_limits<double>::quiet_NaN();
    }
  });
  bool any = false;
  for (const double x : values) {
    if (std::isnan(x)) continue;
    section.least = any ? std::min(section.least, x) : x;
    section.most = any ? std::max(section.most, x) : x;
    any = true;
  }
  section.outline = ZeroLines(section.mesh, values).lines();
  section.mesh.columns = {{"value", "", 1, std::move(values)}};
  section.mesh.name = "section";
  return section;
}

}  // namespace blendwright
