#pragma once
// What happens along the trimlines, as plots.
#include <vector>

#include "app/pipeline/picture_input.hpp"
#include "kernel/exchange/picture.hpp"

namespace blendwright {

/// Of a job: gap, angle and curvature jump with their tolerances, |T| of both sides (the magnitude laws), the
/// length of the lines that join corresponding points, and their places along both trimlines (fraction of
/// the arc length); of trimlines from files: gap, angle and jump. Empty without trimlines.
[[nodiscard]] std::vector<Plot> trimline_plots(const PictureInput& input);

}  // namespace blendwright
