#pragma once
// Private: where the camera of a picture stands and what it sees.
#include <limits>
#include <optional>

#include "kernel/exchange/canvas.hpp"
#include "kernel/exchange/picture.hpp"

class vtkRenderer;

namespace blendwright {

/// The camera's axes: `back` towards the eye.
struct ViewFrame {
  Vec3 right, up, back;
};
/// z is up, or y when the view is along z. Throws InputError ("view") when it has no direction.
[[nodiscard]] ViewFrame frame_of(const Vec3& to_eye);
/// The views of a picture: its list, or its one view.
[[nodiscard]] std::vector<PictureView> views_of(const Picture& picture);

/// Extent of the object along the camera's axes.
struct ViewExtent {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::max()), hi = -lo;
  void add(const ViewFrame& f, const Vec3& p) {
    const Vec3 q(f.right.dot(p), f.up.dot(p), f.back.dot(p));
    lo = lo.cwiseMin(q);
    hi = hi.cwiseMax(q);
  }
  [[nodiscard]] bool empty() const { return lo.x() > hi.x(); }
  [[nodiscard]] double size() const { return (hi - lo).norm(); }
};

/// `all`: of everything; `focus`: of what the picture is about, the lines and the coloured or opaque meshes.
struct ViewExtents {
  ViewExtent all, focus;
};
[[nodiscard]] ViewExtents extents_of(const Picture& picture, const ViewFrame& frame);

/// Parallel projection: the window's middle along right and up, and half its height, model units.
struct ViewWindow {
  double x = 0.0, y = 0.0, half_height = 1.0;
  [[nodiscard]] double pixels_per_unit(const PixelBox& area) const {
    return 0.5 * area.height() / half_height;
  }
};
/// Fits everything into the area, or the surroundings of the focus.
[[nodiscard]] ViewWindow window_of(const ViewExtents& extents, const PixelBox& area);
void aim(vtkRenderer& renderer, const ViewFrame& frame, const ViewExtents& extents, const ViewWindow& window);

}  // namespace blendwright
