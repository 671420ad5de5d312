#pragma once
// `fit` of a scene of soft objects to points.
#include <string>

#include "app/cli/verbs.hpp"

namespace blendwright {

/// `text`: of the scene file. Throws what guarded() makes messages of; the exit code says whether the solver
/// converged and every number is determined.
[[nodiscard]] int fit_scene_file(const FitCommand& command, const std::string& text, const Console& console,
                                 Run& run);

}  // namespace blendwright
