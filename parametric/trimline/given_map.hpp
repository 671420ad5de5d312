#pragma once
// The map of a correspondence that is given by points. Private to this module.
#include <vector>

#include "kernel/base/error.hpp"
#include "parametric/trimline/correspondence.hpp"
#include "parametric/trimline/line_map.hpp"

namespace blendwright {

/// g(t) = t + p(t), p the spline through value - t. The points must have passed check_map.
[[nodiscard]] FractionMap given_map(const std::vector<LawPoint>& points, bool closed);

/// Everything wrong with the points of a map, under the name "map".
[[nodiscard]] std::vector<Problem> check_map(const std::vector<LawPoint>& points, bool closed);

}  // namespace blendwright
