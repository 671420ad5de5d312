#include "implicit/offset/ball_maximum.hpp"

#include <algorithm>
#include <cmath>

namespace blendwright::detail {
namespace {

/// w of (2) at l = least + more, where gaps are least - s_i.
Vec3 point_at(const Vec3& g, const Vec3& gaps, double more) {
  Vec3 w = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    if (g[i] != 0.0) w[i] = g[i] / (2.0 * (more + gaps[i]));
  return w;
}

/// The root of |w(least + more)| = radius by Newton's method for 1/|w| - 1/radius, from below, in a bracket.
double multiplier(const Vec3& g, const Vec3& gaps, double radius, double start) {
  constexpr int most_steps = 100;
  double lo = start, hi = std::max(start, g.stableNorm() / (2.0 * radius)), more = start;
  for (int k = 0; k < most_steps; ++k) {
    const Vec3 w = point_at(g, gaps, more);
    const double size = w.stableNorm();
    if (size == radius) break;
    (size > radius ? lo : hi) = more;
    double sum = 0.0;
    for (int i = 0; i < 3; ++i)
      if (g[i] != 0.0) sum += (w[i] / size) * (w[i] / size) / (more + gaps[i]);
    double next = more + (size - radius) / radius / sum;
    if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
    if (next == more || next == lo || next == hi) break;
    more = next;
  }
  return more;
}

}  // namespace

BallMaximum maximum_on_ball(const Vec3& s, const Vec3& g, double radius) {
  BallMaximum top;
  int steepest = 0;
  s.maxCoeff(&steepest);
  const double least = std::max(0.0, s[steepest]);
  top.gaps = (least - s.array()).matrix();
  // No component of w is larger than the radius.
  const double start = std::max(0.0, (g.cwiseAbs() / (2.0 * radius) - top.gaps).maxCoeff());
  top.l = least;
  if (start == 0.0) {
    top.w = point_at(g, top.gaps, 0.0);
    const double size = top.w.stableNorm();
    if (size <= radius) {
      if (least == 0.0) return top;
      const double rest = std::sqrt((radius - size) * (radius + size));
      top.w[steepest] += rest;
      top.tie = rest > 0.0;
      return top;
    }
  }
  const double more = multiplier(g, top.gaps, radius, start);
  top.l = least + more;
  top.w = point_at(g, top.gaps, more);
  top.w *= radius / top.w.stableNorm();
  top.gaps.array() += more;
  return top;
}

Eigen::Matrix3d moved_hessian(const Vec3& s, const BallMaximum& top) {
  const Vec3 sizes = top.gaps.cwiseAbs();
  if (top.l == 0.0 || top.tie || !(sizes.minCoeff() > 1e-14 * sizes.maxCoeff()))
    return Eigen::Matrix3d::Zero();
  const Vec3 u = top.w / top.w.stableNorm(), m = top.gaps.cwiseInverse();
  const Vec3 p = s.cwiseProduct(m).cwiseProduct(u);
  const double across = u.cwiseProduct(m).dot(u);
  Eigen::Matrix3d h = (-2.0 / across) * (p * p.transpose());
  h.diagonal() += 2.0 * top.l * s.cwiseProduct(m);
  if (!h.allFinite()) return Eigen::Matrix3d::Zero();
  return h;
}

}  // namespace blendwright::detail
