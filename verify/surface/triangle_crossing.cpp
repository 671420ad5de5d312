#include "verify/surface/triangle_crossing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace blendwright::detail {
namespace {

constexpr std::size_t next(std::size_t k) { return k == 2 ? 0 : k + 1; }

struct Plane {
  Vec3 n;                      ///< unit; zero for a triangle without area
  std::array<Vec3, 3> inward;  ///< unit, in the plane, from each edge into the triangle
};

Plane plane_of(const Triangle& t, double tolerance) {
  const std::array<Vec3, 3> edge{t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  const Vec3 n = edge[0].cross(-edge[2]);
  const double longest = std::max({edge[0].norm(), edge[1].norm(), edge[2].norm()});
  // |n| / longest is the triangle's smallest height.
  if (!(n.norm() > tolerance * longest)) return {Vec3::Zero(), {}};
  Plane plane{n.normalized(), {}};
  for (std::size_t k = 0; k < 3; ++k) plane.inward[k] = plane.n.cross(edge[k]).normalized();
  return plane;
}

std::array<double, 3> heights(const Triangle& t, const Plane& plane, const Vec3& origin, double tolerance) {
  std::array<double, 3> h{};
  for (std::size_t k = 0; k < 3; ++k) {
    h[k] = plane.n.dot(t[k] - origin);
    if (std::abs(h[k]) <= tolerance) h[k] = 0.0;
  }
  return h;
}

bool one_side(const std::array<double, 3>& h) {
  return (h[0] >= 0.0 && h[1] >= 0.0 && h[2] >= 0.0) || (h[0] <= 0.0 && h[1] <= 0.0 && h[2] <= 0.0);
}

void keep_deeper(std::optional<Crossing>& best, const Crossing& candidate) {
  if (!best || candidate.depth > best->depth) best = candidate;
}

// Edges of `t` (triangle number `owner`) against the other triangle, given the heights of t's corners over
// it. The ends must lie strictly beyond the plane; the edges of the other triangle count as its inside, so
// that a crossing through an edge of the mesh is seen by one of the two triangles there.
void add_piercing(std::optional<Crossing>& best, const Triangle& t, int owner, const std::array<double, 3>& h,
                  const Triangle& other, const Plane& plane, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double h0 = h[k], h1 = h[next(k)];
    if (!(h0 * h1 < 0.0)) continue;
    const double along = h0 / (h0 - h1);
    const Vec3 point = t[k] + along * (t[next(k)] - t[k]);
    bool inside = true;
    for (std::size_t e = 0; e < 3; ++e)
      inside = inside && plane.inward[e].dot(point - other[e]) >= -tolerance;
    if (!inside) continue;
    keep_deeper(best, {point, std::min(std::abs(h0), std::abs(h1)), owner, static_cast<int>(k), along});
  }
}

// Both triangles in one plane: edges that cross strictly, and a corner strictly inside the other triangle.
void add_coplanar(std::optional<Crossing>& best, const Triangle& t, int owner, const Triangle& other,
                  const Plane& plane, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<double, 3> depth{};
    for (std::size_t e = 0; e < 3; ++e) depth[e] = plane.inward[e].dot(t[k] - other[e]);
    const double least = *std::min_element(depth.begin(), depth.end());
    if (least > tolerance) keep_deeper(best, {t[k], least, owner, static_cast<int>(k), 0.0});
    for (std::size_t e = 0; e < 3; ++e) {
      const double h0 = depth[e], h1 = plane.inward[e].dot(t[next(k)] - other[e]);
      if (!(std::min(h0, h1) < -tolerance && std::max(h0, h1) > tolerance)) continue;
      const double along = h0 / (h0 - h1);
      const Vec3 point = t[k] + along * (t[next(k)] - t[k]);
      const Vec3 edge = other[next(e)] - other[e];
      const double length = edge.norm(), at = edge.dot(point - other[e]) / length;
      if (at > tolerance && at < length - tolerance)
        keep_deeper(best, {point, std::min(std::abs(h0), std::abs(h1)), owner, static_cast<int>(k), along});
    }
  }
}

}  // namespace

std::optional<Crossing> crossing(const Triangle& a, const Triangle& b, double tolerance) {
  const Plane plane_b = plane_of(b, tolerance);
  if (plane_b.n.isZero(0.0)) return std::nullopt;
  const std::array<double, 3> ha = heights(a, plane_b, b[0], tolerance);
  const bool flat = ha[0] == 0.0 && ha[1] == 0.0 && ha[2] == 0.0;
  if (!flat && one_side(ha)) return std::nullopt;

  const Plane plane_a = plane_of(a, tolerance);
  if (plane_a.n.isZero(0.0)) return std::nullopt;
  std::optional<Crossing> best;
  if (flat) {
    add_coplanar(best, a, 0, b, plane_b, tolerance);
    add_coplanar(best, b, 1, a, plane_a, tolerance);
    return best;
  }
  const std::array<double, 3> hb = heights(b, plane_a, a[0], tolerance);
  if (one_side(hb)) return std::nullopt;
  add_piercing(best, a, 0, ha, b, plane_b, tolerance);
  add_piercing(best, b, 1, hb, a, plane_a, tolerance);
  return best;
}

}  // namespace blendwright::detail
