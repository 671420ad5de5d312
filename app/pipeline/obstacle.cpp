#include "app/pipeline/obstacle.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "app/json/json_value.hpp"
#include "app/pipeline/bodies.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "kernel/exchange/point_files.hpp"
#include "kernel/mesh/mesh_distance.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;

fs::path in_folder(const std::string& place, const fs::path& folder) {
  const fs::path file(place);
  return file.is_absolute() ? file : folder / file;
}

bool is_mesh(const std::string& extension) {
  return extension == ".stl" || extension == ".ply" || extension == ".obj" || extension == ".vtp";
}

Obstacle of_scene(const std::string& place, const fs::path& folder, LengthUnit unit) {
  const Body body = read_body(solid_place(in_folder(place, folder).string()));
  if (body.scene.spec.unit != unit)
    throw InputError("", in_quotes(place) + " is in " + name(body.scene.spec.unit) + ", must be in " +
                             name(unit) + " as the job is, since lengths are compared");
  return [field = body.scene.scene.field](const Vec3& p) {
    const FieldValues at = field.evaluate(Order::gradient, std::array{p});
    const double phi = inside(field.level(), at.value(0));
    const Vec3 g = -sense(field.level()) * at.gradient(0);  // points outward
    const double slope = g.norm();
    // Where the field is flat (beyond its influence) nothing is known but that the solid is not here.
    if (!(slope > 1e-12) || !std::isfinite(phi))
      return ObstacleSample{phi > 0.0 ? -1.0 : std::numeric_limits<double>::max(), Vec3::Zero()};
    return ObstacleSample{-phi / slope, g / slope};
  };
}

bool closed(const MeshTree& tree) {
  for (std::uint32_t t = 0; t < tree.mesh().triangles.size(); ++t) {
    const auto c = tree.corners(t);
    for (std::size_t e = 0; e < 3; ++e) {
      const Vec3 middle = 0.5 * (c[e] + c[(e + 1) % 3]);
      MeshFoot foot = tree.closest_on(t, middle);
      if (tree.on_border(foot)) return false;
    }
  }
  return true;
}

Obstacle of_mesh(const fs::path& file) {
  const MeshTree tree(read_mesh(file));
  const bool sided = tree.oriented() && closed(tree);
  return [tree, sided](const Vec3& p) {
    const MeshFoot foot = tree.closest(p);
    const Vec3 away = p - foot.point;
    const Vec3 n = sided ? tree.side_normal(foot) : Vec3(Vec3::Zero());
    const double side = sided && away.dot(n) < 0.0 ? -1.0 : 1.0;
    // On the surface itself the way out is the normal.
    const Vec3 gradient = foot.distance > 0.0 ? Vec3(side * away / foot.distance) : n;
    return ObstacleSample{side * foot.distance, gradient};
  };
}

}  // namespace

Obstacle read_obstacle(const std::string& place, const fs::path& folder, LengthUnit unit) {
  const std::string solid = solid_place(in_folder(place, folder).string()).file;
  const std::string extension = lower_case_extension(solid);
  if (extension == ".json") return of_scene(place, folder, unit);
  if (is_mesh(extension)) return of_mesh(in_folder(place, folder));
  throw InputError(
      "", "is " + in_quotes(place) + ", must end in .stl, .vtp, .ply or .obj (a mesh) or .json (a scene)");
}

std::vector<Vec3> read_scan(const std::string& place, const fs::path& folder) {
  const fs::path file = in_folder(place, folder);
  const std::string extension = lower_case_extension(file);
  const bool mesh = is_mesh(extension) && extension != ".vtp";
  std::vector<Vec3> points = mesh ? read_mesh(file).points : read_points(file);
  if (points.empty()) throw InputError("", in_quotes(place) + " has no points, must have at least one");
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite())
      throw InputError(
          "", "point " + std::to_string(i + 1) + " of " + in_quotes(place) + " is not finite; leave it out");
  return points;
}

}  // namespace blendwright
