#pragma once
// What a result was asked for and what was measured of it, as facts of its mesh files.
#include <string>
#include <vector>

#include "app/json/scene_reader.hpp"
#include "app/pipeline/run_job.hpp"
#include "kernel/mesh/mesh.hpp"

namespace blendwright {

/// Each under "<blend>: ...": mode, continuity from and to (indices with labels); tension, q, or b, c, d (a
/// number or one per component); factor from and to (rows of t and value), tangent angle from and to; the
/// worst gap, angle and curvature jump of each side at the last stage, and the tolerances.
[[nodiscard]] std::vector<Column> blend_facts(const BlendResult& blend, const JobSpec& job);

/// The numbers of every node under "<node>: <key>", as in the file.
[[nodiscard]] std::vector<Column> scene_facts(const SceneSpec& scene);

/// "1/mm" of mean_curvature, "1/mm^2" of gaussian_curvature; "" of another column.
[[nodiscard]] std::string curvature_unit(const std::string& column, LengthUnit unit);

}  // namespace blendwright
