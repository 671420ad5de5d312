#pragma once
// Private: what an ExtremaSurface holds.
#include <variant>

#include "kernel/brep/extrema.hpp"
#include "kernel/brep/primary_geometry.hpp"

namespace blendwright {

struct ExtremaSurface::Impl {
  std::variant<detail::PrimaryGeometry, Surface> held;
};

/// The geometry under a face, in its own parameters.
[[nodiscard]] ExtremaSurface extrema_surface(const opencascade::handle<Geom_Surface>& geometry,
                                             const SurfaceDomain& box);

}  // namespace blendwright
