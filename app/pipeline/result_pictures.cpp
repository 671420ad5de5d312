#include "app/pipeline/result_pictures.hpp"

#include <algorithm>

#include "app/pipeline/picture_views.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

std::vector<const TriMesh*> addresses(const std::vector<TriMesh>& meshes) {
  std::vector<const TriMesh*> all;
  for (const TriMesh& mesh : meshes) all.push_back(&mesh);
  return all;
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
  const auto figure = [](double x) { return x >= 0.01 && x < 1e5 ? number_text(x, 2) : scientific_text(x); };
  Picture picture;
  picture.title = result.job.name + ": largest gap " + figure(gap) + " " + unit + ", largest angle " +
                  figure(angle) + " deg";
  if (result.blends.size() == 1)
    picture.title += std::string(" (") + name(result.blends[0].entry.shape.mode) + " mode)";
  picture.column = "gap";
  picture.bar_title = "gap (" + unit + ")";
  picture.logarithmic = true;
  picture.view = view_of_blends(addresses(blends), addresses(primaries));
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
