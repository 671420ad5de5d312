#pragma once
// Laws given by points as splines. Private to this module.
#include <optional>
#include <string>
#include <vector>

#include "kernel/base/error.hpp"
#include "parametric/trimline/correspondence.hpp"
#include "parametric/trimline/scalar_spline.hpp"

namespace blendwright {

/// Quintic spline (C4) through the points over t; nullopt for a single point, which is a constant. Closed:
/// periodic with period 1; few points are repeated over several periods so that the spline exists. Open: the
/// first and last value hold at t = 0 and 1 when no point is given there.
[[nodiscard]] std::optional<ScalarSpline> law_spline(const std::vector<LawPoint>& points, bool closed);

/// What is wrong with the t of point i: not in [0, 1], or not above that of the point before.
[[nodiscard]] std::vector<Problem> check_law_place(const std::vector<LawPoint>& points, std::size_t i,
                                                   const std::string& where);

}  // namespace blendwright
