#pragma once
// Private: what lies under a pixel of the viewer. No display is needed.
#include <functional>
#include <optional>
#include <vector>

#include "app/view/window/camera.hpp"
#include "app/view/window/document.hpp"

namespace blendwright {

/// Where the ray meets the surfaces that `wanted` accepts, nearest to the eye first.
[[nodiscard]] std::vector<SurfaceHit> hits_of(const Ray& ray, const std::vector<DrawnSurface>& surfaces,
                                              const std::function<bool(const DrawnSurface&)>& wanted);

/// The handle whose mark is nearest to the pixel, within `reach` pixels.
[[nodiscard]] std::optional<std::size_t> handle_at(const Vec2& pixel,
                                                   const std::vector<SessionHandle>& handles,
                                                   const ViewCamera& camera, const PixelBox& pane,
                                                   double reach);

/// Where a handle is dragged to: on the primaries for one of a trimline (the place nearest to the handle, so
/// that it does not jump to another sheet), else at the handle's depth.
[[nodiscard]] Vec3 drag_target(const SessionHandle& handle, const Vec2& pixel,
                               const std::vector<DrawnSurface>& surfaces, const ViewCamera& camera,
                               const PixelBox& pane);

}  // namespace blendwright
