#include "app/pipeline/mesh_pictures.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/exchange/picture.hpp"

namespace blendwright {
namespace {

constexpr double shown_part = 0.98;
const Colour plain{0.85, 0.62, 0.35};

/// Values below the 2nd percentile or above the 98th stay there; NaN stays NaN.
void clamp_to_percentiles(std::vector<double>& values) {
  std::vector<double> finite;
  for (const double x : values)
    if (std::isfinite(x)) finite.push_back(x);
  if (finite.empty()) return;
  const auto at = [&](double part) {
    const auto i = static_cast<std::ptrdiff_t>(part * static_cast<double>(finite.size() - 1));
    std::nth_element(finite.begin(), finite.begin() + i, finite.end());
    return finite[static_cast<std::size_t>(i)];
  };
  const double lo = at(1.0 - shown_part), hi = at(shown_part);
  for (double& x : values)
    if (std::isfinite(x)) x = std::clamp(x, lo, hi);
}

std::string spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// The mesh with the one column that the picture shows, as it shows it.
TriMesh shown_mesh(const TriMesh& mesh, const std::string& colour) {
  TriMesh shown{mesh.name, mesh.points, mesh.normals, mesh.triangles, {}, {}};
  for (const Column& c : mesh.columns)
    if (c.name == colour) shown.columns.push_back(c);
  for (Column& c : shown.columns) {
    if (c.name == "distance_error")
      for (double& x : c.values) x = std::abs(x);
    else if (c.name != "member")
      clamp_to_percentiles(c.values);
  }
  return shown;
}

}  // namespace

void write_mesh_picture(const std::filesystem::path& png, const SceneFile& scene, const TriMesh& mesh,
                        const std::string& colour, std::vector<std::string>& notes) {
  const Display display;
  if (!display.available()) {
    notes.push_back("pictures skipped: " + display.reason());
    return;
  }
  Picture picture;
  picture.title = scene.name == scene.spec.solid || scene.spec.solid.rfind('/', 0) == 0
                      ? scene.name
                      : scene.name + ": " + scene.spec.solid;
  picture.meshes.push_back({shown_mesh(mesh, colour), plain, 1.0, !colour.empty()});
  if (!colour.empty()) {
    picture.column = colour;
    const Column& column = picture.meshes.front().mesh.columns.at(0);
    picture.bar_title = spaced(colour) + (column.unit.empty() ? "" : " (" + column.unit + ")");
    picture.logarithmic = colour == "distance_error";
  }
  write_picture(png, picture, display);
}

}  // namespace blendwright
