#include "parametric/rolling_ball/ball_contact.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/math/small_solve.hpp"

namespace blendwright {
namespace {

using Cause = BallFailure::Cause;

Vec2 defects(const BallPair& pair, const BallContact& contact) {
  return {contact.feet[0].distance - pair.radius[0], contact.feet[1].distance - pair.radius[1]};
}

}  // namespace

bool parallel(const BallContact& contact, double limit) {
  // |n1 x n2|^2 = (1 - |n1.n2|)(1 + |n1.n2|)
  return contact.feet[0].normal.cross(contact.feet[1].normal).squaredNorm() <= 2.0 * limit;
}

double residual(const BallPair& pair, const BallContact& contact) {
  return defects(pair, contact).cwiseAbs().maxCoeff();
}

Vec3 spine_tangent(const BallContact& contact) {
  const Vec3 w = contact.feet[0].normal.cross(contact.feet[1].normal);
  const double size = w.norm();
  return size > 0.0 ? Vec3(w / size) : Vec3(Vec3::Zero());
}

double spine_curvature(const BallContact& contact) {
  const auto& [a, b] = contact.feet;
  const Vec3 w = a.normal.cross(b.normal), T = spine_tangent(contact);
  const double size = w.norm();
  if (!(size > 0.0)) return 0.0;
  const Vec3 dw = (a.turn * T).cross(b.normal) + a.normal.cross(b.turn * T);
  return (dw - T * T.dot(dw)).norm() / size;
}

Corrected feet_of(const BallPair& pair, const Vec3& c, const std::array<BallFoot, 2>& near) {
  BallContact contact{c, {}};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto foot = pair.primaries[i].foot(c, near[i]);
    if (!foot) return Cause::lost;
    if (!foot->inside) return Cause::domain;
    if (!(foot->room > 0.0)) return Cause::curvature;
    contact.feet[i] = *foot;
  }
  return contact;
}

Corrected corrected(const BallPair& pair, const Vec3& start, const std::array<BallFoot, 2>& near,
                    int max_iterations) {
  Corrected at = feet_of(pair, start, near);
  for (int k = 0;; ++k) {
    const auto* contact = std::get_if<BallContact>(&at);
    if (!contact || residual(pair, *contact) <= touching(pair)) return at;
    if (parallel(*contact, parallel_normals)) return Cause::tangent;
    if (k == max_iterations) return Cause::lost;
    const Vec3 &n1 = contact->feet[0].normal, &n2 = contact->feet[1].normal;
    const Vec2 E = defects(pair, *contact);
    const double g = n1.dot(n2), w = n1.cross(n2).squaredNorm();
    const Vec3 c = contact->c - ((E[0] - g * E[1]) * n1 + (E[1] - g * E[0]) * n2) / w;
    if (!c.allFinite()) return Cause::lost;
    const std::array<BallFoot, 2> feet = contact->feet;
    at = feet_of(pair, c, feet);
  }
}

Corrected corrected_in_plane(const BallPair& pair, const Vec3& start, const Vec3& origin, const Vec3& normal,
                             const std::array<BallFoot, 2>& near) {
  constexpr int max_iterations = 20;
  const Vec3 across = normal.normalized();
  Corrected at = feet_of(pair, start, near);
  // One step more once it touches: the residual is then rounding only, at hardly any cost.
  bool last = false;
  for (int k = 0;; ++k) {
    const auto* contact = std::get_if<BallContact>(&at);
    if (!contact || last) return at;
    // The ends of a spine may be as near to a tangent place as the tracer goes.
    if (parallel(*contact, 1e-3 * parallel_normals)) return Cause::tangent;
    if (k == max_iterations) return Cause::lost;
    Eigen::Matrix3d N;
    N << contact->feet[0].normal.transpose(), contact->feet[1].normal.transpose(), across.transpose();
    const Vec2 E = defects(pair, *contact);
    const double off = (contact->c - origin).dot(across);
    const Vec3 c = contact->c - solve_small<3, 1>(N, Vec3(E[0], E[1], off));
    if (!c.allFinite()) return Cause::lost;
    last = E.cwiseAbs().maxCoeff() <= touching(pair) && std::abs(off) <= touching(pair);
    const std::array<BallFoot, 2> feet = contact->feet;
    at = feet_of(pair, c, feet);
  }
}

}  // namespace blendwright
