#pragma once
// Curves typed in a job: formulas of v, or points.
#include <map>
#include <string>

#include "app/pipeline/job.hpp"
#include "kernel/geometry/curve.hpp"

namespace blendwright {

/// Dim 2: parameters of a surface; Dim 3: space. Throws InputError (relative `where`: "curve/0", "points").
template <int Dim>
[[nodiscard]] Curve<Dim> make_curve(const CurveSpec& spec, const std::map<std::string, double>& constants);

}  // namespace blendwright
