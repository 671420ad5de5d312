#include "app/pipeline/result_meshes.hpp"

#include <algorithm>
#include <limits>

#include "kernel/base/number_text.hpp"
#include "kernel/geometry/curvature.hpp"

namespace blendwright {
namespace {

std::string shape_note(const BlendResult& blend) {
  const OdeBlend& surface = blend.blend.surface;
  const BlendShape& shape = surface.shape();
  std::string text = blend.entry.name + ": " + name(shape.mode) + " mode";
  if (shape.frame != BlendFrame::global) text += std::string(", ") + name(shape.frame) + " frame";
  if (surface.order() == 6)
    return text + ", " + name(shape.family) + " with tension " + number_text(shape.tension);
  if (shape.repeated_root) return text + ", q = " + number_text(*shape.repeated_root);
  for (std::size_t x = 0; x < (shape.isotropic() ? 1u : 3u); ++x)
    text += std::string(", (b, c, d) = (") + number_text(shape.ode[x].b) + ", " +
            number_text(shape.ode[x].c) + ", " + number_text(shape.ode[x].d) + ")";
  return text;
}

/// Piecewise linear interpolation of a seam's samples at v.
double sample(const std::vector<double>& vs, const std::vector<double>& values, double v) {
  if (vs.empty() || values.size() != vs.size()) return 0.0;
  const auto above = std::lower_bound(vs.begin(), vs.end(), v);
  if (above == vs.begin()) return values.front();
  if (above == vs.end()) return values.back();
  const auto i = static_cast<std::size_t>(above - vs.begin());
  const double t = (v - vs[i - 1]) / (vs[i] - vs[i - 1]);
  return values[i - 1] + t * (values[i] - values[i - 1]);
}

struct SeamErrors {
  double gap = 0.0, angle_deg = 0.0, curvature = 0.0;
};

SeamErrors errors_at(const SeamReport& seam, double v) {
  return {sample(seam.v, seam.gap_at, v), Radians(sample(seam.v, seam.angle_at, v)).degrees(),
          sample(seam.v, seam.curvature_at, v)};
}

std::vector<Column> error_columns(std::size_t points, LengthUnit unit) {
  const std::string length = name(unit);
  const std::vector<double> zero(points, 0.0);
  return {
      {"gap", length, 1, zero}, {"angle_deg", "deg", 1, zero}, {"curvature_jump", "1/" + length, 1, zero}};
}

void set(std::vector<Column>& columns, std::size_t i, const SeamErrors& e) {
  columns[0].values[i] = e.gap;
  columns[1].values[i] = e.angle_deg;
  columns[2].values[i] = e.curvature;
}

const Column& column(const TriMesh& mesh, const char* wanted) {
  return *std::find_if(mesh.columns.begin(), mesh.columns.end(),
                       [&](const Column& c) { return c.name == wanted; });
}

}  // namespace

TriMesh blend_mesh(const BlendResult& blend, LengthUnit unit) {
  constexpr int across = 32, along = 192;
  TriMesh mesh = tessellate(blend.fit.surface, across, along);
  mesh.name = blend.entry.name;
  mesh.note = shape_note(blend);
  const std::size_t n = mesh.points.size();
  const std::vector<double> us = column(mesh, "u").values, vs = column(mesh, "v").values;
  std::vector<Column> errors = error_columns(n, unit);
  const std::string length = name(unit);
  Column mean{"mean_curvature", "1/" + length, 1, std::vector<double>(n)};
  Column gaussian{"gaussian_curvature", "1/" + length + "^2", 1, std::vector<double>(n)};
  Column deviation{"fit_deviation", length, 1, std::vector<double>(n)};
  const auto& seams = blend.stages.back().seams;
  for (std::size_t i = 0; i < n; ++i) {
    const SeamErrors e0 = errors_at(seams[0], vs[i]), e1 = errors_at(seams[1], vs[i]);
    const double u = us[i], w = 1.0 - u;
    set(errors, i,
        {w * e0.gap + u * e1.gap, w * e0.angle_deg + u * e1.angle_deg, w * e0.curvature + u * e1.curvature});
    const SurfaceJet jet = blend.fit.surface.jet({u, vs[i]});
    const SurfaceCurvature k = curvature(jet);
    mean.values[i] = k.mean;
    gaussian.values[i] = k.gaussian;
    deviation.values[i] = (jet.S - blend.blend.surface.jet({u, vs[i]}).S).norm();
  }
  mesh.columns.insert(mesh.columns.end(), errors.begin(), errors.end());
  mesh.columns.insert(mesh.columns.end(), {mean, gaussian, deviation});
  return mesh;
}

std::array<PolyLine, 2> trimline_lines(const BlendResult& blend, LengthUnit unit) {
  const SurfaceDomain domain = blend.blend.surface.domain();
  const auto line = [&](std::size_t side) {
    constexpr int steps = 512;
    PolyLine l;
    l.name = blend.entry.name + (side == 0 ? " from" : " to");
    l.note = shape_note(blend);
    l.closed = domain.v_closed;
    const int count = domain.v_closed ? steps : steps + 1;
    l.columns = {{"v", "", 1, {}}};
    std::vector<Column> errors = error_columns(static_cast<std::size_t>(count), unit);
    for (int i = 0; i < count; ++i) {
      const double v = domain.v.at(static_cast<double>(i) / steps);
      l.points.push_back(derivative(blend.blend.surface.end(static_cast<int>(side)).series(v).C, 0));
      l.columns[0].values.push_back(v);
      set(errors, static_cast<std::size_t>(i), errors_at(blend.stages.back().seams[side], v));
    }
    l.columns.insert(l.columns.end(), errors.begin(), errors.end());
    return l;
  };
  return {line(0), line(1)};
}

void add_seam_errors(TriMesh& mesh, const std::vector<PolyLine>& lines, LengthUnit unit) {
  std::vector<Column> errors = error_columns(mesh.points.size(), unit);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const PolyLine& line : lines)
      for (std::size_t k = 0; k < line.points.size(); ++k) {
        const double d = (line.points[k] - mesh.points[i]).squaredNorm();
        if (d >= nearest) continue;
        nearest = d;
        set(errors, i, {line.columns[1].values[k], line.columns[2].values[k], line.columns[3].values[k]});
      }
  }
  mesh.columns.insert(mesh.columns.end(), errors.begin(), errors.end());
}

std::string shape_note(const JobResult& result) {
  std::string text;
  for (const BlendResult& blend : result.blends) text += (text.empty() ? "" : "; ") + shape_note(blend);
  return text;
}

Assembly assembly_of(const JobResult& result) {
  Assembly assembly;
  for (std::size_t b = 0; b < result.blends.size(); ++b) {
    const BlendResult& blend = result.blends[b];
    assembly.blends.push_back({blend.entry.name, blend.fit.surface, {}});
    const BlendUnderTest surfaces = under_test(blend, blend.fit.surface);
    for (std::size_t side = 0; side < 2; ++side) {
      if (!blend.primaries[side]) continue;
      const std::string& name = blend.entry.sides[side].primary;
      auto patch = std::find_if(assembly.primaries.begin(), assembly.primaries.end(),
                                [&](const PrimaryPatch& p) { return p.name == name; });
      if (patch == assembly.primaries.end())
        patch = assembly.primaries.insert(patch, PrimaryPatch{name, *blend.primaries[side], {}, {}});
      patch->cuts.push_back(
          {*surfaces.seams[side].pcurve, surfaces.seams[side].kept_left, b, static_cast<int>(side)});
    }
  }
  return assembly;
}

}  // namespace blendwright
