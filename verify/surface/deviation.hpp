#pragma once
// How far two surfaces are from each other.
#include "verify/surface/surface_checks.hpp"

namespace blendwright {

struct SurfaceDeviation {
  Extreme worst;  ///< largest distance of a sample of the first from the second; `at`, `point` on the first
  UV other;       ///< its closest place on the second
  double rms = 0.0;  ///< over the samples, weighted by area
};
/// From the (nu + 1)(nv + 1) samples of `first` to their closest points on `second`; the worst is refined.
/// One side of the Hausdorff distance: ask both ways. NaN where a sample is not finite.
[[nodiscard]] SurfaceDeviation deviation(const Surface& first, const Surface& second, int nu = 24,
                                         int nv = 96, const Progress& progress = {});

}  // namespace blendwright
