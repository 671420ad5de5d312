#include "app/view/window/picking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blendwright {
namespace {

/// Triangles pressed together to a line have no inside; relative to the product of their sides.
constexpr double flat = 1e-12;

Vec3 corner(const DrawnSurface& s, std::uint32_t i) {
  const float* p = &s.positions[3 * std::size_t{i}];
  return {p[0], p[1], p[2]};
}

/// T. Moeller and B. Trumbore, Fast, minimum storage ray/triangle intersection, 1997; both sides count, and
/// so does what lies behind the origin, as the projection is parallel.
std::optional<SurfaceHit> hit_of(const Ray& ray, const DrawnSurface& s, std::size_t triangle) {
  const auto& t = s.triangles[triangle];
  const Vec3 a = corner(s, t[0]), ab = corner(s, t[1]) - a, ac = corner(s, t[2]) - a;
  const Vec3 p = ray.direction.cross(ac);
  const double det = ab.dot(p);
  if (std::abs(det) <= flat * ab.norm() * ac.norm()) return std::nullopt;
  const Vec3 from = ray.origin - s.origin - a;
  const double v = from.dot(p) / det;
  if (v < 0.0 || v > 1.0) return std::nullopt;
  const Vec3 q = from.cross(ab);
  const double w = ray.direction.dot(q) / det;
  if (w < 0.0 || v + w > 1.0) return std::nullopt;
  SurfaceHit hit;
  hit.triangle = triangle;
  hit.distance = ac.dot(q) / det;
  hit.point = ray.origin + hit.distance * ray.direction;
  hit.weights = {1.0 - v - w, v, w};
  return hit;
}

}  // namespace

std::vector<SurfaceHit> hits_of(const Ray& ray, const std::vector<DrawnSurface>& surfaces,
                                const std::function<bool(const DrawnSurface&)>& wanted) {
  std::vector<SurfaceHit> hits;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (!wanted(surfaces[s])) continue;
    for (std::size_t t = 0; t < surfaces[s].triangles.size(); ++t)
      if (auto hit = hit_of(ray, surfaces[s], t)) {
        hit->surface = s;
        hits.push_back(*hit);
      }
  }
  std::stable_sort(hits.begin(), hits.end(),
                   [](const SurfaceHit& a, const SurfaceHit& b) { return a.distance < b.distance; });
  return hits;
}

std::optional<std::size_t> handle_at(const Vec2& pixel, const std::vector<SessionHandle>& handles,
                                     const ViewCamera& camera, const PixelBox& pane, double reach) {
  std::optional<std::size_t> found;
  double least = reach, depth = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < handles.size(); ++i) {
    const double away = (camera.pixel(handles[i].position, pane) - pixel).norm();
    const double towards_eye = camera.back.dot(handles[i].position);
    // Of handles behind each other the one in front is meant.
    if (away > least || (away == least && towards_eye <= depth)) continue;
    found = i;
    least = away;
    depth = towards_eye;
  }
  return found;
}

Vec3 drag_target(const SessionHandle& handle, const Vec2& pixel, const std::vector<DrawnSurface>& surfaces,
                 const ViewCamera& camera, const PixelBox& pane) {
  const Vec3 beside = camera.at_depth_of(handle.position, pixel, pane);
  if (handle.kind == SessionHandle::Kind::magnitude) return beside;
  const auto hits = hits_of(camera.ray(pixel, pane), surfaces,
                            [](const DrawnSurface& s) { return s.role == DrawnSurface::Role::primary; });
  if (hits.empty()) return beside;
  return std::min_element(hits.begin(), hits.end(),
                          [&](const SurfaceHit& a, const SurfaceHit& b) {
                            return (a.point - handle.position).squaredNorm() <
                                   (b.point - handle.position).squaredNorm();
                          })
      ->point;
}

}  // namespace blendwright
