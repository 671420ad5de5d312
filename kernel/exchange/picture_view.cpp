#include "kernel/exchange/picture_view.hpp"

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

constexpr double filled = 0.92;       // of the free area, by the object
constexpr double surroundings = 5.0;  // most that is shown, in sizes of the focus
const Vec3 default_view(1.0, -1.2, 0.8);

/// Half the height of a window of the area's shape around `extent`.
double half_height(const ViewExtent& extent, const PixelBox& area) {
  const Vec3 half = 0.5 * (extent.hi - extent.lo);
  return std::max(half.y(), half.x() * area.height() / area.width()) / filled;
}

/// Middle of the window [c - half, c + half] that lies nearest to `wanted` without leaving [lo, hi] where it
/// fits in.
double middle_within(double wanted, double half, double lo, double hi) {
  return hi - lo <= 2.0 * half ? 0.5 * (lo + hi) : std::clamp(wanted, lo + half, hi - half);
}

}  // namespace

ViewFrame frame_of(const Vec3& to_eye) {
  const double length = to_eye.norm();
  if (!(length > 0.0) || !std::isfinite(length))
    throw InputError("view", "has no direction, must be a finite vector other than 0");
  const Vec3 back = to_eye / length;
  const Vec3 upright = std::abs(back.z()) < 0.99 ? Vec3::UnitZ() : Vec3::UnitY();
  const Vec3 right = upright.cross(back).normalized();
  return {right, back.cross(right), back};
}

std::vector<PictureView> views_of(const Picture& picture) {
  if (!picture.views.empty()) return picture.views;
  return {{"", picture.view.value_or(default_view)}};
}

ViewExtents extents_of(const Picture& picture, const ViewFrame& frame) {
  ViewExtents e;
  for (const PictureMesh& m : picture.meshes)
    for (const Vec3& p : m.mesh.points) {
      e.all.add(frame, p);
      if (m.coloured || m.opacity >= 1.0) e.focus.add(frame, p);
    }
  for (const PolyLine& line : picture.lines)
    for (const Vec3& p : line.points) {
      e.all.add(frame, p);
      e.focus.add(frame, p);
    }
  if (e.focus.empty()) e.focus = e.all;
  return e;
}

ViewWindow window_of(const ViewExtents& extents, const PixelBox& area) {
  const ViewExtent &all = extents.all, &focus = extents.focus;
  const double whole = half_height(all, area), near_focus = surroundings * half_height(focus, area);
  ViewWindow window;
  window.half_height = near_focus > 0.0 ? std::min(whole, near_focus) : whole;
  const Vec3 wanted = 0.5 * (focus.lo + focus.hi);
  const double half_width = filled * window.half_height * area.width() / area.height();
  window.x = middle_within(wanted.x(), half_width, all.lo.x(), all.hi.x());
  window.y = middle_within(wanted.y(), filled * window.half_height, all.lo.y(), all.hi.y());
  return window;
}

void aim(vtkRenderer& renderer, const ViewFrame& frame, const ViewExtents& extents,
         const ViewWindow& window) {
  const ViewExtent& all = extents.all;
  const Vec3 target =
      window.x * frame.right + window.y * frame.up + 0.5 * (all.lo.z() + all.hi.z()) * frame.back;
  const double distance = 4.0 * all.size();
  const Vec3 eye = target + distance * frame.back;
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.ParallelProjectionOn();
  camera.SetFocalPoint(target.data());
  camera.SetPosition(eye.data());
  camera.SetViewUp(frame.up.data());
  camera.SetParallelScale(window.half_height);
  camera.SetClippingRange(distance - all.size(), distance + all.size());
}

}  // namespace blendwright
