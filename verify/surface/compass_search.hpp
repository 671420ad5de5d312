#pragma once
// Refines the best sample of a grid within the surface's domain.
#include <array>

#include "kernel/geometry/surface.hpp"

namespace blendwright::detail {

struct PeakUV {
  UV at;
  double value = 0.0;
};

/// Climbs f from `start` in eight directions, halving the steps (hu, hv) `halvings` times; never ends below
/// the start. NaN is never an improvement. Source: Kolda, Lewis and Torczon, Optimization by direct search,
/// SIAM Review 2003.
template <class F>
[[nodiscard]] PeakUV compass_maximum(F f, const SurfaceDomain& domain, PeakUV start, double hu, double hv,
                                     int halvings = 12) {
  constexpr std::array<std::array<int, 2>, 8> directions{
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
  PeakUV best = start;
  for (int halving = 0; halving < halvings; ++halving, hu *= 0.5, hv *= 0.5) {
    // At most four moves on one scale: the peak lies within the neighbouring cells.
    bool moved = true;
    for (int move = 0; moved && move < 4; ++move) {
      moved = false;
      for (const auto& [du, dv] : directions) {
        const UV at{domain.u.clamp(best.at.u + du * hu), domain.v.clamp(best.at.v + dv * hv)};
        const double value = f(at);
        if (!(value > best.value)) continue;
        best = {at, value};
        moved = true;
        break;
      }
    }
  }
  return best;
}

}  // namespace blendwright::detail
