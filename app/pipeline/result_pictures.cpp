#include "app/pipeline/result_pictures.hpp"

#include <algorithm>

#include "kernel/base/number_text.hpp"

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

/// From above, unless one primary is much larger than all others and lies above the blends: it would hide
/// them.
std::optional<Vec3> view_of(const std::vector<TriMesh>& blends, const std::vector<TriMesh>& primaries) {
  Weighted largest, second, blend;
  for (const TriMesh& mesh : primaries) {
    const Weighted w = centre_of(mesh);
    if (w.area > largest.area) {
      second = largest;
      largest = w;
    } else if (w.area > second.area) {
      second = w;
    }
  }
  for (const TriMesh& mesh : blends) {
    const Weighted w = centre_of(mesh);
    if (w.area > blend.area) blend = w;
  }
  const bool hides = largest.area > 4.0 * second.area && largest.centre.z() > blend.centre.z();
  if (!hides) return std::nullopt;
  return Vec3(1.0, -1.2, -0.8);
}

}  // namespace

Picture error_picture(const JobResult& result, const std::vector<TriMesh>& blends,
                      const std::vector<TriMesh>& primaries, const std::vector<PolyLine>& lines) {
  const std::string unit = name(result.job.unit);
  double gap = 0.0, angle = 0.0;
  for (const BlendResult& b : result.blends)
    for (const SeamReport& s : b.stages.back().seams) {
      gap = std::max(gap, s.gap.worst);
      angle = std::max(angle, Radians(s.angle.worst).degrees());
    }
  Picture picture;
  picture.title = result.job.name + ": largest gap " + scientific_text(gap) + " " + unit +
                  ", largest angle " + scientific_text(angle) + " deg";
  if (result.blends.size() == 1)
    picture.title += std::string(" (") + name(result.blends[0].entry.shape.mode) + " mode)";
  picture.column = "gap";
  picture.bar_title = "gap (" + unit + ")";
  picture.logarithmic = true;
  picture.view = view_of(blends, primaries);
  for (const TriMesh& mesh : primaries) picture.meshes.push_back({mesh, {0.72, 0.75, 0.80}, 1.0, false});
  for (const TriMesh& mesh : blends) picture.meshes.push_back({mesh, {0.90, 0.55, 0.15}, 1.0, true});
  picture.lines = lines;
  return picture;
}

std::vector<Plot> error_plots(const JobResult& result) {
  const std::string unit = name(result.job.unit);
  const Tolerance& tolerance = result.job.tolerance;
  std::vector<Plot> plots{
      {"gap", "v", "gap (" + unit + ")", {}, true, tolerance.position},
      {"angle between tangent planes", "v", "angle (deg)", {}, true, tolerance.angle.degrees()},
      {"normal curvature jump", "v", "jump (1/" + unit + ")", {}, true, tolerance.curvature}};
  for (const BlendResult& blend : result.blends)
    for (const SeamReport& seam : blend.stages.back().seams) {
      std::vector<double> degrees_at;
      for (const double a : seam.angle_at) degrees_at.push_back(Radians(a).degrees());
      plots[0].curves.push_back({seam.name, seam.v, seam.gap_at});
      plots[1].curves.push_back({seam.name, seam.v, degrees_at});
      plots[2].curves.push_back({seam.name, seam.v, seam.curvature_at});
    }
  return plots;
}

}  // namespace blendwright
