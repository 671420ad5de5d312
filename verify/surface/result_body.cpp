#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/geometry/project.hpp"
#include "verify/surface/body_deviation.hpp"

namespace blendwright {
namespace {

/// All pieces as one mesh: points and triangles only.
TriMesh joined(const std::vector<ResultPiece>& pieces) {
  if (pieces.empty()) throw InputError("", "has no surface and no triangles, must have some");
  TriMesh all;
  for (const ResultPiece& piece : pieces) {
    const auto first = static_cast<std::uint32_t>(all.points.size());
    all.points.insert(all.points.end(), piece.mesh.points.begin(), piece.mesh.points.end());
    for (const auto& t : piece.mesh.triangles)
      all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

const std::vector<double>& column(const TriMesh& mesh, const char* name) {
  for (const Column& c : mesh.columns)
    if (c.name == name && c.values.size() == mesh.points.size()) return c.values;
  throw InputError(mesh.name, std::string("has no column \"") + name + "\", which a mesh of a surface needs");
}

/// The same place of a closed direction, next to `near`.
double beside(double t, double near, const Interval& range, bool closed) {
  return closed ? t - range.length() * std::round((t - near) / range.length()) : t;
}

}  // namespace

ResultBody::ResultBody(std::vector<ResultPiece> pieces) : tree_(joined(pieces)) {
  std::uint32_t end = 0;
  for (ResultPiece& piece : pieces) {
    end += static_cast<std::uint32_t>(piece.mesh.triangles.size());
    if (piece.surface) {
      surfaces_ = true;
      const std::vector<double>&u = column(piece.mesh, "u"), &v = column(piece.mesh, "v");
      for (std::size_t i = 0; i < u.size(); ++i) uv_.push_back({u[i], v[i]});
    } else {
      uv_.resize(uv_.size() + piece.mesh.points.size());
    }
    pieces_.push_back({piece.mesh.name, std::move(piece.surface), end});
  }
  if (!surfaces_) return;
  constexpr std::array middle{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
  for (std::uint32_t i = 0; i < end; ++i) {
    if (!piece_of(i).surface) continue;
    const double off = tree_.closest_on(i, point_at(i, middle)).distance;
    if (std::isfinite(off)) sag_ = std::max(sag_, off);
  }
}

const ResultBody::Piece& ResultBody::piece_of(std::uint32_t triangle) const {
  return *std::upper_bound(pieces_.begin(), pieces_.end(), triangle,
                           [](std::uint32_t t, const Piece& p) { return t < p.end; });
}

const std::string& ResultBody::name_of(std::uint32_t triangle) const { return piece_of(triangle).name; }

UV ResultBody::parameters(std::uint32_t triangle, const std::array<double, 3>& weights) const {
  const auto& t = tree_.mesh().triangles[triangle];
  const SurfaceDomain d = piece_of(triangle).surface->domain();
  const UV base = uv_[t[0]];
  UV at{0.0, 0.0};
  for (std::size_t k = 0; k < 3; ++k) {
    at.u += weights[k] * beside(uv_[t[k]].u, base.u, d.u, d.u_closed);
    at.v += weights[k] * beside(uv_[t[k]].v, base.v, d.v, d.v_closed);
  }
  return at;
}

Vec3 ResultBody::point_at(std::uint32_t triangle, const std::array<double, 3>& weights) const {
  if (const auto& surface = piece_of(triangle).surface) return surface->point(parameters(triangle, weights));
  const auto corners = tree_.corners(triangle);
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

ResultBody::Foot ResultBody::closest(const Vec3& q) const {
  const MeshFoot flat = tree_.closest(q);
  const auto side = [&](const Vec3& foot) { return (q - foot).dot(tree_.side_normal(flat)); };
  const auto& surface = piece_of(flat.triangle).surface;
  if (surface && q.allFinite()) {
    const blendwright::Foot round = closest_point(*surface, q, parameters(flat.triangle, flat.weights));
    // A foot within the sag of the mesh is on the trimmed face; Newton's method may also have left for
    // another sheet, or for the part that is cut away.
    const double sag = 4.0 * sag_ + 1e-12 * tree_.size();
    if (round.distance <= flat.distance + sag && tree_.closest(round.point).distance <= sag)
      return {round.point, round.distance, side(round.point)};
  }
  return {flat.point, flat.distance, side(flat.point)};
}

}  // namespace blendwright
