#include "app/view/window/blend_document.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/json/job_reader.hpp"
#include "app/pipeline/result_meshes.hpp"
#include "app/view/window/trimmed_mesh.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/exchange/step_file.hpp"
#include "kernel/geometry/curvature.hpp"
#include "kernel/geometry/project.hpp"

namespace blendwright {
namespace {

constexpr int primary_cells = 192;
constexpr std::size_t comb_lines = 24, comb_hairs = 60, trimline_points = 256;

std::vector<std::array<std::uint32_t, 3>> grid_triangles(const SessionGrid& grid) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const auto nv = static_cast<std::uint32_t>(grid.nv);
  for (std::uint32_t i = 0; i + 1 < grid.nu; ++i)
    for (std::uint32_t j = 0; j + 1 < nv; ++j) {
      const std::uint32_t a = i * nv + j, b = a + 1, c = a + nv, d = c + 1;
      triangles.push_back({a, c, d});
      triangles.push_back({a, d, b});
    }
  return triangles;
}

Vec3 grid_point(const SessionGrid& grid, std::size_t i, std::size_t j) {
  const float* p = &grid.positions[3 * (i * grid.nv + j)];
  return grid.origin + Vec3(p[0], p[1], p[2]);
}

/// Parameters of a row or a column: the ends included.
double fraction(std::size_t i, std::size_t count) {
  return static_cast<double>(i) / static_cast<double>(count - 1);
}

double curvature_figure(const SurfaceCurvature& c, Show show, CurvatureFigure figure) {
  // Pictures count curvatures as positive where the surface is convex seen from the side of its normal.
  if (show == Show::radius) return least_radius(-c.mean, c.gaussian);
  switch (figure) {
    case CurvatureFigure::gaussian:
      return c.gaussian;
    case CurvatureFigure::largest:
      return -c.k_min;
    case CurvatureFigure::least:
      return -c.k_max;
    default:
      return -c.mean;
  }
}

/// T points out of the kept part of the primary at u = 0 and into that at u = 1.
KeptSide kept_side(const OdeBlend& blend, int side) {
  KeptSide line;
  const Interval v = blend.domain().v;
  for (std::size_t j = 0; j <= trimline_points; ++j) {
    const SurfaceJet jet = blend.jet({static_cast<double>(side), v.at(fraction(j, trimline_points + 1))});
    line.points.push_back(jet.S);
    line.inward.push_back((side == 0 ? -1.0 : 1.0) * jet.Su);
  }
  return line;
}

PickedPoint on_primary(const std::string& name, const Surface& surface, const Vec3& near) {
  const Foot foot = closest_point(surface, near);
  const SurfaceJet jet = surface.jet(foot.at);
  const SurfaceCurvature c = curvature(jet);
  PickedPoint found;
  found.object = name;
  found.point = foot.point;
  found.uv = foot.at;
  found.normal = unit_normal(jet);
  found.mean_curvature = -c.mean;
  found.gaussian_curvature = c.gaussian;
  found.least_radius = least_radius(-c.mean, c.gaussian);
  return found;
}

}  // namespace

BlendDocument::BlendDocument(std::filesystem::path file, const std::string& text)
    : file_(std::move(file)), session_(text, read_job(text, file_)) {
  if (session_.blends() > 0) triangles_ = grid_triangles(session_.grid(0));
  for (const auto& [name, surface] : session_.primaries()) {
    whole_primaries_.push_back(tessellate(surface, primary_cells, primary_cells));
    whole_primaries_.back().name = name;
  }
  trim_primaries();
  first_shape_ = shape();
}

void BlendDocument::trim_primaries() {
  primaries_.clear();
  for (const TriMesh& whole : whole_primaries_) {
    std::vector<KeptSide> lines;
    for (std::size_t k = 0; k < session_.blends(); ++k)
      for (std::size_t side = 0; side < 2; ++side)
        if (session_.job().blends[k].sides[side].primary == whole.name)
          lines.push_back(kept_side(session_.blend(k).surface, static_cast<int>(side)));
    primaries_.emplace_back(trimmed_mesh(whole, lines));
  }
}

Document::Outcome BlendDocument::drag(const SessionHandle& handle, const Vec3& target) {
  Outcome outcome = session_.drag(handle, target);
  // Cutting the primaries anew takes longer than the blend itself: when the handle is let go.
  lines_moved_ = lines_moved_ || (outcome.done && handle.kind == SessionHandle::Kind::trimline);
  return outcome;
}

Document::Outcome BlendDocument::commit() {
  session_.commit();
  if (std::exchange(lines_moved_, false)) trim_primaries();
  return {};
}

bool BlendDocument::undo() {
  const bool done = session_.undo();
  if (done) trim_primaries();
  return done;
}

bool BlendDocument::redo() {
  const bool done = session_.redo();
  if (done) trim_primaries();
  return done;
}

std::vector<DrawnSurface> BlendDocument::surfaces() const {
  std::vector<DrawnSurface> all;
  for (std::size_t k = 0; k < session_.blends(); ++k) {
    const SessionGrid& grid = session_.grid(k);
    all.push_back({DrawnSurface::Role::blend, session_.job().blends[k].name, grid.origin, grid.positions,
                   grid.normals, triangles_});
  }
  for (const DrawnMesh& p : primaries_) all.push_back(p.drawn(DrawnSurface::Role::primary));
  return all;
}

std::vector<PolyLine> BlendDocument::lines() const {
  std::vector<PolyLine> lines;
  for (std::size_t k = 0; k < session_.blends(); ++k) {
    const SessionGrid& grid = session_.grid(k);
    for (const std::size_t i : {std::size_t{0}, grid.nu - 1}) {
      PolyLine line;
      line.name = session_.job().blends[k].name + (i == 0 ? " from" : " to");
      for (std::size_t j = 0; j < grid.nv; ++j) line.points.push_back(grid_point(grid, i, j));
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

std::vector<CombLine> BlendDocument::comb() const {
  std::vector<CombLine> all;
  for (std::size_t k = 0; k < session_.blends(); ++k)
    for (CombLine& line : comb_across(Surface(session_.blend(k).surface), comb_lines, comb_hairs, 1.0))
      all.push_back(std::move(line));
  return all;
}

std::vector<float> BlendDocument::values(std::size_t surface, Show show, const ShowOptions& options) const {
  if (surface >= session_.blends()) return {};  // primaries stand back behind the colours
  const SessionGrid& grid = session_.grid(surface);
  if (show == Show::gap) return grid.gap;
  if (show == Show::angle) return grid.angle_deg;
  if (show == Show::curvature && options.curvature == CurvatureFigure::jump) return grid.curvature_jump;
  if (show == Show::curvature || show == Show::radius) return curvature_values(surface, show, options);
  if (show != Show::zebra && show != Show::isophotes && show != Show::draft) return {};
  std::vector<float> values(grid.nu * grid.nv);
  values_of_normals(show, options, grid.normals, values);
  return values;
}

std::vector<float> BlendDocument::curvature_values(std::size_t blend, Show show,
                                                   const ShowOptions& options) const {
  const SessionGrid& grid = session_.grid(blend);
  const OdeBlend& surface = session_.blend(blend).surface;
  const Interval v = surface.domain().v;
  std::vector<float> values(grid.nu * grid.nv);
  parallel_for(values.size(), grid.nv, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const UV at{fraction(k / grid.nv, grid.nu), v.at(fraction(k % grid.nv, grid.nv))};
      values[k] = static_cast<float>(curvature_figure(curvature(surface.jet(at)), show, options.curvature));
    }
  });
  return values;
}

PictureInput BlendDocument::shape() const {
  PictureInput input;
  input.name = file_.stem().string();
  input.unit = unit();
  for (std::size_t k = 0; k < session_.blends(); ++k) {
    const SessionGrid& grid = session_.grid(k);
    const Surface surface(session_.blend(k).surface);
    const Interval v = surface.domain().v;
    TriMesh mesh;
    mesh.name = session_.job().blends[k].name;
    mesh.triangles = triangles_;
    Column us{"u", "", 1, {}}, vs{"v", "", 1, {}};
    for (std::size_t i = 0; i < grid.nu; ++i)
      for (std::size_t j = 0; j < grid.nv; ++j) {
        const float* n = &grid.normals[3 * (i * grid.nv + j)];
        mesh.points.push_back(grid_point(grid, i, j));
        mesh.normals.emplace_back(n[0], n[1], n[2]);
        us.values.push_back(fraction(i, grid.nu));
        vs.values.push_back(v.at(fraction(j, grid.nv)));
      }
    mesh.columns = {std::move(us), std::move(vs)};
    input.parts.push_back({PicturePart::Role::blend, std::move(mesh), surface});
  }
  return input;
}

UV BlendDocument::uv_of(const SurfaceHit& hit) const {
  const SessionGrid& grid = session_.grid(hit.surface);
  const Interval v = session_.blend(hit.surface).surface.domain().v;
  UV at{0.0, 0.0};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t point = triangles_[hit.triangle][k];
    at.u += hit.weights[k] * fraction(point / grid.nv, grid.nu);
    at.v += hit.weights[k] * v.at(fraction(point % grid.nv, grid.nv));
  }
  return at;
}

PickedPoint BlendDocument::picked(const SurfaceHit& hit) const {
  if (hit.surface < session_.blends()) return session_.picked(hit.surface, uv_of(hit));
  const auto& [name, surface] = session_.primaries().at(hit.surface - session_.blends());
  return on_primary(name, surface, hit.point);
}

std::optional<BlendSession::Errors> BlendDocument::errors() const {
  BlendSession::Errors worst;
  for (std::size_t k = 0; k < session_.blends(); ++k) {
    const BlendSession::Errors e = session_.errors(k);
    worst.gap = std::max(worst.gap, e.gap);
    worst.angle_deg = std::max(worst.angle_deg, e.angle_deg);
    worst.curvature_jump = std::max(worst.curvature_jump, e.curvature_jump);
  }
  return worst;
}

std::string BlendDocument::figures() const { return error_text(*errors(), unit()); }

Vec3 BlendDocument::foot_of(const SessionHandle& handle) const {
  const OdeBlend& surface = session_.blend(handle.blend).surface;
  return surface.jet({static_cast<double>(handle.side), handle.v}).S;
}

std::vector<std::string> BlendDocument::groups() const {
  std::vector<std::string> names;
  for (const BlendEntry& b : session_.job().blends) names.push_back(b.name);
  return names;
}

void BlendDocument::export_step(const std::filesystem::path& to) const {
  const JobResult result = session_.result();
  const AssemblyResult joined = assemble(assembly_of(result), result.job.tolerance.position);
  write_step(to, joined.shape,
             {.schema = result.job.output.step_schema,
              .unit = result.job.unit,
              .product = result.job.name,
              .note = shape_note(result)});
}

}  // namespace blendwright
