#pragma once
// Whether a rolling ball meets a primary or another part elsewhere than at its feet. Private to this module.
#include <vector>

#include "parametric/rolling_ball/ball_cover.hpp"
#include "parametric/rolling_ball/spine.hpp"

namespace blendwright {

/// The two primaries and the other parts, covered once.
class BallParts {
 public:
  BallParts(const BallPair& pair, const SpineSpec& spec);

  /// Of primary i, 0 or 1.
  [[nodiscard]] const std::vector<CoverCell>& cells(std::size_t i) const { return cells_[i]; }
  /// The deepest place, over the traced points, where a part is in the ball by more than 1e-9 of the radius;
  /// nullopt: none was found. Looks at a point of every cell, and at feet from the nearest ones.
  [[nodiscard]] std::optional<BallFailure> interference(const Spine& spine) const;

 private:
  [[nodiscard]] double depth(const SpinePoint& point, std::size_t part, double r) const;
  std::vector<BallPrimary> parts_;
  std::vector<std::vector<CoverCell>> cells_;
  double size_;
};

}  // namespace blendwright
