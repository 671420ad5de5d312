#include "app/view/window/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernel/exchange/picture_view.hpp"

namespace blendwright {
namespace {

constexpr double fill = 0.88;  // of the pane that a fitted object takes along its tighter direction
Vec2 middle(const PixelBox& pane) { return {0.5 * (pane.left + pane.right), 0.5 * (pane.bottom + pane.top)}; }

}  // namespace

Vec2 ViewCamera::pixel(const Vec3& p, const PixelBox& pane) const {
  const Vec3 d = p - focus;
  return middle(pane) + pixels_per_unit(pane) * Vec2(right.dot(d), up.dot(d));  // (1)
}

Ray ViewCamera::ray(const Vec2& at, const PixelBox& pane) const {
  const Vec2 d = (at - middle(pane)) / pixels_per_unit(pane);
  return {focus + d.x() * right + d.y() * up, -back};
}

Vec3 ViewCamera::at_depth_of(const Vec3& p, const Vec2& at, const PixelBox& pane) const {
  return ray(at, pane).origin + back.dot(p - focus) * back;
}

ViewCamera ViewCamera::orbited(const Vec2& pixels, const PixelBox& pane) const {
  const double turn = std::numbers::pi / std::min(pane.width(), pane.height());
  // The object follows the mouse: the camera turns the other way.
  const Eigen::AngleAxisd about_up(-turn * pixels.x(), up), about_right(turn * pixels.y(), right);
  const Eigen::Quaterniond rotation(about_up * about_right);
  ViewCamera turned = *this;
  turned.back = (rotation * back).normalized();
  turned.right = (rotation * up).cross(turned.back).normalized();
  turned.up = turned.back.cross(turned.right);
  return turned;
}

ViewCamera ViewCamera::panned(const Vec2& pixels, const PixelBox& pane) const {
  ViewCamera moved = *this;
  moved.focus -= (pixels.x() * right + pixels.y() * up) / pixels_per_unit(pane);
  return moved;
}

ViewCamera ViewCamera::zoomed(double factor, const Vec2& at, const PixelBox& pane) const {
  ViewCamera nearer = *this;
  nearer.half_height /= factor;
  nearer.focus += ray(at, pane).origin - nearer.ray(at, pane).origin;
  return nearer;
}

ViewCamera ViewCamera::looking(const Vec3& to_eye) const {
  const ViewFrame frame = frame_of(to_eye);
  ViewCamera turned = *this;
  turned.right = frame.right;
  turned.up = frame.up;
  turned.back = frame.back;
  return turned;
}

ViewCamera ViewCamera::fitted(const std::vector<Vec3>& points, const PixelBox& pane) const {
  ViewExtent extent;
  const ViewFrame frame{right, up, back};
  for (const Vec3& p : points)
    if (p.allFinite()) extent.add(frame, p);
  if (extent.empty()) return *this;
  ViewCamera fit = *this;
  const Vec3 centre = 0.5 * (extent.lo + extent.hi), size = extent.hi - extent.lo;
  fit.focus = centre.x() * right + centre.y() * up + centre.z() * back;
  fit.half_height = 0.5 / fill * std::max({size.y(), size.x() * pane.height() / pane.width()});
  if (!(fit.half_height > 0.0)) fit.half_height = 1.0;
  return fit;
}

}  // namespace blendwright
