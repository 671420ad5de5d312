#include "parametric/shape_fit/foot_point.hpp"

#include <algorithm>
#include <cmath>

namespace blendwright::detail {

FootGrid::FootGrid(const BlendModel::At& blend, bool closed) {
  constexpr int across = 12, along = 128;
  points_.resize(3, (across + 1) * (along + 1));
  std::vector<WeightsAt> weights;
  for (int i = 0; i <= across; ++i) weights.push_back(blend.weights(static_cast<double>(i) / across, false));
  Eigen::Index k = 0;
  for (int j = 0; j <= along - (closed ? 1 : 0); ++j) {
    const double t = static_cast<double>(j) / along;
    const Section section = blend.section(t, false);
    for (int i = 0; i <= across; ++i) {
      places_.push_back({static_cast<double>(i) / across, t});
      points_.col(k++) = blend.jet(section, weights[static_cast<std::size_t>(i)], false).part(at_S);
    }
  }
  points_.conservativeResize(3, k);
}

FootPoint FootGrid::nearest(const Vec3& q) const {
  Eigen::Index best = 0;
  (points_.colwise() - q).colwise().squaredNorm().minCoeff(&best);
  return places_[static_cast<std::size_t>(best)];
}

FootPoint closest(const BlendModel::At& blend, bool closed, const Vec3& q, FootPoint p) {
  constexpr int most_steps = 40;
  const auto kept = [closed](FootPoint f) {
    f.u = std::clamp(f.u, 0.0, 1.0);
    f.t = closed ? f.t - std::floor(f.t) : std::clamp(f.t, 0.0, 1.0);
    return f;
  };
  JetAt jet = blend.jet(p.u, p.t, false);
  double value = (jet.part(at_S) - q).squaredNorm();
  for (int step = 0; step < most_steps; ++step) {
    const Vec3 d = jet.part(at_S) - q, Su = jet.part(at_Su), St = jet.part(at_Sv);
    const double gu = d.dot(Su), gt = d.dot(St);
    double a = Su.squaredNorm() + d.dot(jet.part(at_Suu)), b = Su.dot(St) + d.dot(jet.part(at_Suv)),
           c = St.squaredNorm() + d.dot(jet.part(at_Svv));
    if (!(a > 0.0 && c > 0.0 && a * c > b * b)) {  // far from the surface: the convex part alone
      a = Su.squaredNorm();
      b = Su.dot(St);
      c = St.squaredNorm();
    }
    const bool hold_u = (p.u <= 0.0 && gu > 0.0) || (p.u >= 1.0 && gu < 0.0);
    const bool hold_t = !closed && ((p.t <= 0.0 && gt > 0.0) || (p.t >= 1.0 && gt < 0.0));
    double du = 0.0, dt = 0.0;
    if (hold_u && hold_t) break;
    if (hold_u) {
      dt = -gt / c;
    } else if (hold_t) {
      du = -gu / a;
    } else {
      const double det = a * c - b * b;
      if (!(det > 0.0)) break;
      du = (-gu * c + gt * b) / det;
      dt = (-gt * a + gu * b) / det;
    }
    dt = std::clamp(dt, -0.1, 0.1);
    // Newton's last step squares what is missing: it needs no check.
    if (std::abs(du) < 1e-8 && std::abs(dt) < 1e-8) return kept({p.u + du, p.t + dt});
    double factor = 1.0;
    bool moved = false;
    for (int half = 0; half < 12 && !moved; ++half, factor *= 0.5) {
      const FootPoint next = kept({p.u + factor * du, p.t + factor * dt});
      JetAt there = blend.jet(next.u, next.t, false);
      const double at = (there.part(at_S) - q).squaredNorm();
      if (!(at < value)) continue;
      moved = true;
      p = next;
      value = at;
      jet = std::move(there);
    }
    if (!moved) break;
  }
  return p;
}

FootDistance signed_distance(const JetAt& foot, const Vec3& q) {
  const Vec3 d = foot.part(at_S) - q, N = foot.part(at_Su).cross(foot.part(at_Sv));
  const Vec3 n = N.norm() > 0.0 ? Vec3(N.normalized()) : Vec3(Vec3::Zero());
  const double along = d.dot(n), size = d.norm();
  // Over the edge of the surface the shortest way is not along the normal.
  if (size <= (1.0 + 1e-7) * std::abs(along)) return {along, n};
  const double sign = along < 0.0 ? -1.0 : 1.0;
  return {sign * size, sign / size * d};
}

}  // namespace blendwright::detail
