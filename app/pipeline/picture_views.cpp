#include "app/pipeline/picture_views.hpp"

#include "app/json/json_value.hpp"
#include "app/json/object_reader.hpp"
#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

struct Weighted {
  double area = 0.0;
  Vec3 centre = Vec3::Zero();
};

Weighted centre_of(const TriMesh& mesh) {
  Weighted w;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const double area = 0.5 * (b - a).cross(c - a).norm();
    w.area += area;
    w.centre += area * (a + b + c) / 3.0;
  }
  if (w.area > 0.0) w.centre /= w.area;
  return w;
}

}  // namespace

std::span<const NamedView> named_views() {
  static const NamedView views[] = {
      {"iso", {1.0, -1.2, 0.8}},    {"front", {0.0, -1.0, 0.0}},    {"back", {0.0, 1.0, 0.0}},
      {"left", {-1.0, 0.0, 0.0}},   {"right", {1.0, 0.0, 0.0}},     {"top", {0.0, 0.0, 1.0}},
      {"bottom", {0.0, 0.0, -1.0}}, {"iso-back", {-1.0, 1.2, 0.8}}, {"iso-below", {1.0, -1.2, -0.8}},
  };
  return views;
}

std::vector<PictureView> views_named(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const NamedView& v : named_views()) known.emplace_back(v.name);
  std::vector<PictureView> views;
  std::vector<Problem> problems;
  for (const std::string& name : names) {
    bool found = false;
    for (const NamedView& v : named_views()) {
      if (v.name != name) continue;
      views.push_back({name, v.direction});
      found = true;
    }
    if (!found)
      problems.push_back(
          {"--views", "has " + in_quotes(name) + ", must be " + listed(known) + suggestion(name, known)});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return views;
}

std::optional<Vec3> view_of_blends(std::span<const TriMesh* const> blends,
                                   std::span<const TriMesh* const> primaries) {
  Weighted largest, second, blend;
  for (const TriMesh* mesh : primaries) {
    const Weighted w = centre_of(*mesh);
    if (w.area > largest.area) {
      second = largest;
      largest = w;
    } else if (w.area > second.area) {
      second = w;
    }
  }
  for (const TriMesh* mesh : blends) {
    const Weighted w = centre_of(*mesh);
    if (w.area > blend.area) blend = w;
  }
  const bool hides = largest.area > 4.0 * second.area && largest.centre.z() > blend.centre.z();
  if (!hides) return std::nullopt;
  return Vec3(1.0, -1.2, -0.8);
}

}  // namespace blendwright
