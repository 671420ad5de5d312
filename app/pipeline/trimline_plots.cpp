#include "app/pipeline/trimline_plots.hpp"

#include <algorithm>
#include <cmath>

#include "app/pipeline/result_pictures.hpp"

namespace blendwright {
namespace {

constexpr int steps = 256;
constexpr double dash = 7.0;  // of the second side: both laws are often the same

struct LawPlots {
  Plot magnitude, length, places;
};

/// Running arc length over the whole, by chords.
std::vector<double> fractions(const std::vector<Vec3>& points) {
  std::vector<double> s{0.0};
  for (std::size_t i = 1; i < points.size(); ++i) s.push_back(s.back() + (points[i] - points[i - 1]).norm());
  for (double& x : s) x /= s.back() > 0.0 ? s.back() : 1.0;
  return s;
}

void add_laws(const BlendResult& blend, LawPlots& plots) {
  const OdeBlend& surface = blend.blend.surface;
  const Interval range = surface.domain().v;
  std::vector<double> vs;
  std::array<std::vector<Vec3>, 2> points;
  PlotCurve length{blend.entry.name, {}, {}};
  std::array<PlotCurve, 2> magnitude;
  for (int i = 0; i <= steps; ++i) {
    const double v = range.at(static_cast<double>(i) / steps);
    vs.push_back(v);
    for (std::size_t side = 0; side < 2; ++side) {
      const EndSeries at = surface.end(static_cast<int>(side)).series(v);
      points[side].push_back(derivative(at.C, 0));
      magnitude[side].y.push_back(derivative(at.T, 0).norm());
    }
    length.y.push_back((points[1].back() - points[0].back()).norm());
  }
  length.x = vs;
  plots.length.curves.push_back(std::move(length));
  for (std::size_t side = 0; side < 2; ++side) {
    const std::string name = blend.stages.back().seams[side].name;
    magnitude[side].label = name;
    magnitude[side].x = vs;
    magnitude[side].dash = side == 0 ? 0.0 : dash;
    plots.magnitude.curves.push_back(std::move(magnitude[side]));
    plots.places.curves.push_back({name, vs, fractions(points[side]), side == 0 ? 0.0 : dash});
  }
}

std::vector<Plot> plots_of_job(const JobResult& result) {
  const std::string unit = name(result.job.unit);
  LawPlots laws{{"magnitude of the cross tangents", "v", "|T| (" + unit + ")", {}, false, {}},
                {"connecting lines", "v", "length (" + unit + ")", {}, false, {}},
                {"correspondence", "v", "fraction of arc length", {}, false, {}}};
  for (const BlendResult& blend : result.blends) add_laws(blend, laws);
  std::vector<Plot> plots = error_plots(result);
  plots.insert(plots.end(), {std::move(laws.magnitude), std::move(laws.length), std::move(laws.places)});
  return plots;
}

const Column* column_of(const PolyLine& line, const char* name) {
  for (const Column& c : line.columns)
    if (c.name == name) return &c;
  return nullptr;
}

std::vector<Plot> plots_of_lines(const PictureInput& input) {
  const std::string unit = input.unit ? name(*input.unit) : "";
  const auto with = [](const char* figure, const std::string& u) {
    return u.empty() ? std::string(figure) : std::string(figure).append(" (").append(u).append(")");
  };
  std::vector<Plot> plots{
      {"gap", "v", with("gap", unit), {}, true, {}},
      {"angle between tangent planes", "v", "angle (deg)", {}, true, {}},
      {"normal curvature jump", "v", with("jump", unit.empty() ? "" : "1/" + unit), {}, true, {}}};
  bool any = false;
  for (const PolyLine& line : input.lines) {
    const Column* v = column_of(line, "v");
    const char* names[] = {"gap", "angle_deg", "curvature_jump"};
    for (std::size_t i = 0; v && i < 3; ++i)
      if (const Column* c = column_of(line, names[i])) {
        plots[i].curves.push_back({line.name, v->values, c->values});
        any = true;
      }
  }
  if (!any) plots.clear();
  return plots;
}

}  // namespace

std::vector<Plot> trimline_plots(const PictureInput& input) {
  return input.job ? plots_of_job(*input.job) : plots_of_lines(input);
}

}  // namespace blendwright
