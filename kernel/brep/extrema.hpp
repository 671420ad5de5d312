#pragma once
// Points of a surface, and distances to it, as the CAD kernel computes them: a second opinion on our own
// evaluation and our own search for closest points. Nothing of kernel/geometry is called where the CAD kernel
// has the same geometry.
#include <memory>

#include "kernel/geometry/surface.hpp"

namespace blendwright {

/// The closest point that the CAD kernel finds.
struct ExtremaFoot {
  UV at;                  ///< parameters of our surface
  double distance = 0.0;  ///< to it; NaN when none was found
  double slack = 0.0;  ///< the distance is right to this, what the search left along the surface considered
};

class ExtremaSurface {
 public:
  /// Planes, circular cylinders, cones, spheres, tori, B-splines and faces of a part are the CAD kernel's own
  /// geometry. Of any other surface it is told points and derivatives, and only the search is its own.
  [[nodiscard]] static ExtremaSurface of(const Surface& surface);

  /// False: points are those of our surface.
  [[nodiscard]] bool evaluates() const;
  /// S at the parameters of our surface.
  [[nodiscard]] Vec3 point(UV at) const;
  /// Distance to the surface continued a little beyond open borders: a joint may stand on one. Of several
  /// extrema the nearest. Searches the whole surface: microseconds for elementary ones, about a millisecond
  /// for others.
  [[nodiscard]] ExtremaFoot closest(const Vec3& q) const;

  struct Impl;
  explicit ExtremaSurface(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

 private:
  std::shared_ptr<const Impl> impl_;
};

}  // namespace blendwright
