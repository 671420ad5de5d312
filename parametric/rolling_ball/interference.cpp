#include "parametric/rolling_ball/interference.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/number_text.hpp"
#include "parametric/rolling_ball/spine_trace.hpp"

namespace blendwright {

BallParts::BallParts(const BallPair& pair, const SpineSpec& spec)
    : parts_(pair.primaries.begin(), pair.primaries.end()), size_(spec.seed_size) {
  parts_.insert(parts_.end(), spec.others.begin(), spec.others.end());
  const double r = std::abs(pair.radius[0]);
  const Box reached{spec.box.lo - Vec3::Constant(r + size_), spec.box.hi + Vec3::Constant(r + size_)};
  for (const BallPrimary& part : parts_) cells_.push_back(cover(part, reached, size_));
}

/// How deep a part is in the ball; 0 when it is not.
double BallParts::depth(const SpinePoint& point, std::size_t part, double r) const {
  const bool primary = part < 2;
  const auto own = [&](const Vec3& p) {
    return primary && (p - point.feet[part].point).norm() <= 3.0 * size_;
  };
  double deepest = 0.0;
  const CoverCell* nearest = nullptr;
  double away = r + 2.0 * size_;
  for (const CoverCell& cell : cells_[part]) {
    if (!cell.point) continue;
    const double distance = (*cell.point - point.centre).norm();
    // Points of a surface and of a field stand on it to rounding and to 1e-6 of the coordinates, so that
    // points around the own foot need a margin.
    if (distance < r * (1.0 - 1e-9) && !own(*cell.point)) deepest = std::max(deepest, r - distance);
    if (distance < away && !own(*cell.point)) {
      away = distance;
      nearest = &cell;
    }
  }
  if (!nearest) return deepest;
  const auto foot = parts_[part].foot(point.centre, *nearest->point, nearest->at);
  if (!foot || !foot->inside || !(foot->room > 0.0)) return deepest;
  const double found = r - std::abs(foot->distance);
  return found > 1e-9 * r ? std::max(deepest, found) : deepest;
}

std::optional<BallFailure> BallParts::interference(const Spine& spine) const {
  const double r = spine.radius();
  std::optional<BallFailure> worst;
  for (const SpinePoint& point : spine.points())
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      const double found = depth(point, part, r);
      if (!(found > (worst ? worst->depth : 0.0))) continue;
      worst = failure(BallFailure::Cause::interference, spine.pair(), point.centre);
      worst->depth = found;
      worst->message += ", by " + number_text(found, 3);
    }
  return worst;
}

}  // namespace blendwright
