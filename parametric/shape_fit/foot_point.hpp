#pragma once
// The point of the blend that is closest to a given one. Private to this module.
#include "parametric/shape_fit/blend_model.hpp"

namespace blendwright::detail {

struct FootPoint {
  double u = 0.5, t = 0.0;
};

/// Positions of the blend on a grid, to start from.
class FootGrid {
 public:
  explicit FootGrid(const BlendModel::At& blend, bool closed);
  [[nodiscard]] FootPoint nearest(const Vec3& q) const;

 private:
  std::vector<FootPoint> places_;
  Eigen::Matrix3Xd points_;
};

/// Newton's method on |S - q|^2 within 0 <= u <= 1 (and 0 <= t <= 1 unless closed), with steps halved until
/// they descend.
[[nodiscard]] FootPoint closest(const BlendModel::At& blend, bool closed, const Vec3& q, FootPoint from);

/// Signed distance at a foot point: the derivative by x is direction . dS/dx, since the foot is a minimum.
struct FootDistance {
  double value = 0.0;
  Vec3 direction = Vec3::Zero();
};
[[nodiscard]] FootDistance signed_distance(const JetAt& foot, const Vec3& q);

}  // namespace blendwright::detail
