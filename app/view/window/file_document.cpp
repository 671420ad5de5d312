#include "app/view/window/file_document.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

constexpr std::size_t comb_planes = 7, comb_hairs = 160;

double interpolated(const std::vector<double>& values, const std::array<std::uint32_t, 3>& corners,
                    const std::array<double, 3>& weights) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) sum += weights[i] * values[corners[i]];
  return sum;
}

DrawnSurface::Role role_of(PicturePart::Role role) {
  switch (role) {
    case PicturePart::Role::blend:
      return DrawnSurface::Role::blend;
    case PicturePart::Role::primary:
      return DrawnSurface::Role::primary;
    case PicturePart::Role::other:
      return DrawnSurface::Role::other;
  }
  return DrawnSurface::Role::other;
}

}  // namespace

std::string error_text(const BlendSession::Errors& worst, LengthUnit unit) {
  std::string text = "worst gap ";
  text += scientific_text(worst.gap) + " " + name(unit) + ", angle " + scientific_text(worst.angle_deg) +
          " deg, curvature jump " + scientific_text(worst.curvature_jump) + " 1/" + name(unit);
  return text;
}

DrawnMesh::DrawnMesh(TriMesh mesh) : mesh_(std::move(mesh)) {
  if (!mesh_.points.empty()) {
    Vec3 lo = mesh_.points.front(), hi = lo;
    for (const Vec3& p : mesh_.points) {
      lo = lo.cwiseMin(p);
      hi = hi.cwiseMax(p);
    }
    origin_ = 0.5 * (lo + hi);
  }
  for (const Vec3& p : mesh_.points)
    for (int k = 0; k < 3; ++k) positions_.push_back(static_cast<float>(p[k] - origin_[k]));
  for (const Vec3& n : mesh_.normals)
    for (int k = 0; k < 3; ++k) normals_.push_back(static_cast<float>(n[k]));
}

DrawnSurface DrawnMesh::drawn(DrawnSurface::Role role) const {
  return {role, mesh_.name, origin_, positions_, normals_, mesh_.triangles};
}

std::vector<float> DrawnMesh::values(Show show, const ShowOptions& options) const {
  const std::string wanted = column_of(show, options);
  if (wanted.empty()) return {};
  const Column* column = find_column(mesh_, wanted);
  TriMesh with;
  if (!column) {
    with = mesh_;
    if (!add_column(with, show, options)) return {};
    column = find_column(with, wanted);
  }
  if (!column || column->components != 1) return {};
  return {column->values.begin(), column->values.end()};
}

PickedPoint DrawnMesh::picked(const SurfaceHit& hit) const {
  const auto& corners = mesh_.triangles[hit.triangle];
  PickedPoint found;
  found.object = mesh_.name;
  found.point = hit.point;
  if (!mesh_.normals.empty()) {
    for (std::size_t i = 0; i < 3; ++i) found.normal += hit.weights[i] * mesh_.normals[corners[i]];
  } else {
    const Vec3 a = mesh_.points[corners[0]];
    found.normal = (mesh_.points[corners[1]] - a).cross(mesh_.points[corners[2]] - a);
  }
  found.normal.normalize();
  const auto figure = [&](const char* name) -> std::optional<double> {
    const Column* c = find_column(mesh_, name);
    if (!c || c->components != 1) return std::nullopt;
    return interpolated(c->values, corners, hit.weights);
  };
  const auto u = figure("u"), v = figure("v");
  if (u && v) found.uv = UV{*u, *v};
  found.mean_curvature = figure("mean_curvature");
  found.gaussian_curvature = figure("gaussian_curvature");
  if (found.mean_curvature && found.gaussian_curvature)
    found.least_radius = least_radius(*found.mean_curvature, *found.gaussian_curvature);
  found.gap = figure("gap");
  found.angle_deg = figure("angle_deg");
  found.curvature_jump = figure("curvature_jump");
  return found;
}

FileDocument::FileDocument(std::filesystem::path file, PictureInput input)
    : file_(std::move(file)), lines_(std::move(input.lines)) {
  named_unit_ = input.unit;
  unit_ = input.unit.value_or(LengthUnit::millimetre);
  for (PicturePart& part : input.parts) {
    meshes_.emplace_back(std::move(part.mesh));
    roles_.push_back(role_of(part.role));
    known_.push_back(part.surface);
  }
  // Primaries stand back behind blends; without a blend they are what is looked at.
  if (std::find(roles_.begin(), roles_.end(), DrawnSurface::Role::blend) == roles_.end())
    std::fill(roles_.begin(), roles_.end(), DrawnSurface::Role::other);
}

std::vector<DrawnSurface> FileDocument::surfaces() const {
  std::vector<DrawnSurface> all;
  for (std::size_t i = 0; i < meshes_.size(); ++i) all.push_back(meshes_[i].drawn(roles_[i]));
  return all;
}

std::vector<CombLine> FileDocument::comb() const {
  std::vector<const TriMesh*> meshes;
  for (std::size_t i = 0; i < meshes_.size(); ++i)
    if (roles_[i] != DrawnSurface::Role::primary) meshes.push_back(&meshes_[i].mesh());
  return comb_of_sections(meshes, comb_planes, comb_hairs, nullptr);
}

std::vector<float> FileDocument::values(std::size_t surface, Show show, const ShowOptions& options) const {
  return meshes_.at(surface).values(show, options);
}

PictureInput FileDocument::shape() const {
  PictureInput input;
  input.name = file_.stem().string();
  input.unit = named_unit_;
  for (std::size_t i = 0; i < meshes_.size(); ++i) {
    PicturePart part{PicturePart::Role::other, meshes_[i].mesh(), known_[i]};
    if (roles_[i] == DrawnSurface::Role::primary) part.mesh = {};  // keeps the place
    input.parts.push_back(std::move(part));
  }
  return input;
}

PickedPoint FileDocument::picked(const SurfaceHit& hit) const { return meshes_.at(hit.surface).picked(hit); }

std::optional<BlendSession::Errors> FileDocument::errors() const {
  const auto worst = [&](const char* name) {
    std::optional<double> most;
    for (const DrawnMesh& m : meshes_)
      if (const Column* c = find_column(m.mesh(), name))
        for (const double x : c->values)
          if (!std::isnan(x)) most = std::max(most.value_or(0.0), x);
    return most;
  };
  const auto gap = worst("gap"), angle = worst("angle_deg"), jump = worst("curvature_jump");
  if (!gap || !angle) return std::nullopt;
  return BlendSession::Errors{*gap, *angle, jump.value_or(0.0)};
}

std::string FileDocument::figures() const {
  if (const auto worst = errors()) return error_text(*worst, unit_);
  std::size_t points = 0, triangles = 0;
  for (const DrawnMesh& m : meshes_) {
    points += m.mesh().points.size();
    triangles += m.mesh().triangles.size();
  }
  return std::to_string(meshes_.size()) + (meshes_.size() == 1 ? " surface, " : " surfaces, ") +
         std::to_string(points) + " points, " + std::to_string(triangles) + " triangles";
}

}  // namespace blendwright
