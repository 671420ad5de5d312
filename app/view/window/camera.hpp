#pragma once
// Private: the camera that all panes of the viewer share, a parallel projection, and rays through pixels.
//
//   pixel = middle of the pane + s (right.(p - focus), up.(p - focus)),   s = height of the pane / (2 h) (1)
//
// with h half the height that is seen, model units.
#include <vector>

#include "kernel/exchange/canvas.hpp"

namespace blendwright {

struct Ray {
  Vec3 origin, direction;  ///< direction is a unit vector away from the eye
};

struct ViewCamera {
  Vec3 focus = Vec3::Zero();
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY(), back = Vec3::UnitZ();  ///< back: towards the eye
  double half_height = 1.0;

  [[nodiscard]] double pixels_per_unit(const PixelBox& pane) const {
    return 0.5 * pane.height() / half_height;
  }
  /// (1)
  [[nodiscard]] Vec2 pixel(const Vec3& p, const PixelBox& pane) const;
  /// Through the pixel, from the plane of the focus.
  [[nodiscard]] Ray ray(const Vec2& pixel, const PixelBox& pane) const;
  /// The point that the pixel shows at the depth of `p`.
  [[nodiscard]] Vec3 at_depth_of(const Vec3& p, const Vec2& pixel, const PixelBox& pane) const;

  [[nodiscard]] ViewCamera orbited(const Vec2& pixels, const PixelBox& pane) const;
  [[nodiscard]] ViewCamera panned(const Vec2& pixels, const PixelBox& pane) const;
  /// `factor` > 1: nearer; the point under `at` stays there.
  [[nodiscard]] ViewCamera zoomed(double factor, const Vec2& at, const PixelBox& pane) const;
  /// Looks from `to_eye`, z upwards (y when looking along z), and sees the points in the pane.
  [[nodiscard]] ViewCamera looking(const Vec3& to_eye) const;
  [[nodiscard]] ViewCamera fitted(const std::vector<Vec3>& points, const PixelBox& pane) const;
};

}  // namespace blendwright
