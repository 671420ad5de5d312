#pragma once
// A scene whose numbers are fitted to points: the scene file that has them, and what changed.
#include <string>
#include <vector>

#include "app/json/scene_reader.hpp"
#include "app/pipeline/stage_time.hpp"
#include "implicit/fit/scene_fit.hpp"

namespace blendwright {

struct SceneFitJob {
  std::string points;  ///< file: .vtp, .stl, .obj or .ply, or lines of x, y, z
  std::vector<std::string>
      unknowns;               ///< "form/a=1,10": node, key, bounds; "body/turn"; empty: all that can be
  SceneFitOptions options{};  ///< without its unknowns
};

struct SceneFitOutcome {
  SceneFile before;
  std::string points_name;
  SceneFitResult fit;
  std::string text;  ///< of the fitted scene: what did not change stays as it is typed
};

/// "form/a=1,10" as an unknown. Throws InputError (where: `where`).
[[nodiscard]] SceneUnknown typed_unknown(const std::string& text, const std::string& where);

/// `text`: the scene file's own. Throws InputError (JSON pointers, or names of flags: "--points",
/// "--unknown"), IoError, ConvergenceError, Cancelled.
[[nodiscard]] SceneFitOutcome run_scene_fit(const std::string& text, const std::string& file,
                                            const SceneFitJob& job, const Progress& progress = {});

/// Version, input hash, what changed and how well it is determined, as JSON.
[[nodiscard]] std::string scene_fit_json(const SceneFitOutcome& outcome);

}  // namespace blendwright
