#include "app/pipeline/picture_deviation.hpp"

#include <algorithm>
#include <cmath>

#include "app/pipeline/show.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/geometry/project.hpp"
#include "kernel/mesh/mesh_distance.hpp"

namespace blendwright {
namespace {

constexpr double border_slack = 2.0;  // a foot this many facet errors away is on another part of the surface

struct Target {
  const PicturePart* part;
  MeshTree tree;
  double facet = 0.0;  ///< how far its triangles may be from the surface
  const Column *u = nullptr, *v = nullptr;
};

/// Largest distance of a triangle's edge from the surface: a chord whose ends' normals differ by an angle has
/// the height length angle / 8.
double facet_error(const TriMesh& mesh) {
  double worst = 0.0;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      const Vec3 chord = mesh.points[b] - mesh.points[a];
      worst = std::max(worst, std::abs(chord.dot(mesh.normals[b] - mesh.normals[a])) / 8.0);
    }
  return worst;
}

std::vector<Target> targets_of(const PictureInput& other) {
  std::vector<Target> targets;
  for (const PicturePart& part : other.parts) {
    if (part.mesh.triangles.empty()) continue;
    if (part.mesh.normals.empty())
      throw InputError("--to",
                       "has no normals, which the sign of the deviation needs; must be a .vtp, a .ply, a "
                       ".step or what it was made from");
    Target t{&part, MeshTree(part.mesh), facet_error(part.mesh)};
    if (part.surface) {
      t.u = find_column(part.mesh, "u");
      t.v = find_column(part.mesh, "v");
    }
    targets.push_back(std::move(t));
  }
  if (targets.empty())
    throw InputError("--to", "has no surface, must have one that distances can be measured to");
  return targets;
}

double interpolated(const Column& column, const std::array<std::uint32_t, 3>& t, const MeshFoot& foot) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) sum += foot.weights[i] * column.values[t[i]];
  return sum;
}

/// Parameters that jump at a seam cannot be interpolated: the corner's own are near enough to start from.
UV start_of(const Target& target, const MeshFoot& foot) {
  const auto& t = target.part->mesh.triangles[foot.triangle];
  const SurfaceDomain domain = target.part->surface->domain();
  const auto start = [&](const Column& c, const Interval& range, bool closed) {
    const auto [lo, hi] = std::minmax({c.values[t[0]], c.values[t[1]], c.values[t[2]]});
    return closed && hi - lo > 0.5 * range.length() ? c.values[t[0]] : interpolated(c, t, foot);
  };
  return {start(*target.u, domain.u, domain.u_closed), start(*target.v, domain.v, domain.v_closed)};
}

struct Nearest {
  double distance = 0.0;  ///< signed
  bool exact = false;
};

Nearest nearest(const Target& target, const MeshFoot& foot, const Vec3& p) {
  const TriMesh& mesh = target.part->mesh;
  const auto& t = mesh.triangles[foot.triangle];
  Vec3 n = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) n += foot.weights[i] * mesh.normals[t[i]];
  const double facets = std::copysign(foot.distance, (p - foot.point).dot(n));
  if (!target.u || !target.v) return {facets, false};
  const Foot exact = closest_point(*target.part->surface, p, start_of(target, foot));
  // Trimmed parts end before their surfaces do.
  const double slack = border_slack * target.facet + 1e-12 * (1.0 + p.norm());
  if (std::abs(exact.distance - foot.distance) > slack) return {facets, false};
  return {std::copysign(exact.distance, (p - exact.point).dot(n)), true};
}

/// To the nearest of all targets.
double distance_to(const std::vector<Target>& targets, const Vec3& p) {
  const Target* best = nullptr;
  MeshFoot foot;
  for (const Target& target : targets) {
    const MeshFoot f = target.tree.closest(p);
    if (best && f.distance >= foot.distance) continue;
    best = &target;
    foot = f;
  }
  return nearest(*best, foot, p).distance;
}

}  // namespace

DeviationFacts add_deviation(PictureInput& input, const PictureInput& other, const Progress& progress) {
  if (input.unit && other.unit && *input.unit != *other.unit)
    throw InputError("--to", std::string("is in ") + name(*other.unit) + ", must be in " + name(*input.unit) +
                                 " as " + input.name + " is, since lengths are compared");
  const std::vector<Target> targets = targets_of(other);
  const ScalarField* field = other.scene ? &other.scene->scene.field : nullptr;
  DeviationFacts facts;
  for (const Target& t : targets)
    if (!t.u || !t.v) facts.facets = std::max(facts.facets, t.facet);
  double squares = 0.0;
  std::size_t count = 0;
  for (PicturePart& part : input.parts) {
    const std::vector<Vec3>& points = part.mesh.points;
    Column column{"deviation", input.unit ? name(*input.unit) : "", 1, std::vector<double>(points.size())};
    parallel_for(points.size(), 512, [&](std::size_t begin, std::size_t end) {
      progress.at(0.0, "measuring the deviation");
      std::optional<FieldValues> values;
      if (field) values = field->evaluate(Order::gradient, std::span(points).subspan(begin, end - begin));
      for (std::size_t i = begin; i < end; ++i) {
        double d = distance_to(targets, points[i]);
        if (values) {
          const double first_order =
              -inside(field->level(), values->value(i - begin)) / values->gradient(i - begin).norm();
          // Its error is of second order in the distance, that of the triangles is theirs.
          if (std::abs(first_order) < std::sqrt(targets.front().facet) &&
              std::abs(first_order - d) <= 4.0 * targets.front().facet)
            d = first_order;
        }
        column.values[i] = d;
      }
    });
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double d = std::abs(column.values[i]);
      squares += d * d;
      ++count;
      if (d <= facts.worst && facts.worst > 0.0) continue;
      facts.worst = d;
      facts.at = points[i];
    }
    part.mesh.columns.push_back(std::move(column));
  }
  facts.rms = count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
  return facts;
}

}  // namespace blendwright
