#pragma once
// Where a modulus along a line falls to zero. Private to this module.
#include <functional>
#include <vector>

#include "kernel/geometry/curve.hpp"

namespace blendwright {

/// The places to sample: 257 equal steps of an open range, 256 of a closed one (its end is its start).
[[nodiscard]] std::vector<double> zero_scan_places(const CurveDomain& domain);

/// Zeros of `size` >= 0, given its `values` at zero_scan_places: minima refined by golden section that stay
/// below 1e-6 of the mean. `size` is asked beyond the ends of a closed range, never of an open one.
[[nodiscard]] std::vector<double> zeros(const CurveDomain& domain, const std::vector<double>& values,
                                        const std::function<double(double)>& size);

}  // namespace blendwright
