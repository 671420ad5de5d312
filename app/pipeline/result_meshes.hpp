#pragma once
// A job's result as meshes and lines with the measured errors as point data.
#include <array>
#include <vector>

#include "app/pipeline/run_job.hpp"
#include "kernel/brep/shape.hpp"
#include "kernel/mesh/mesh.hpp"

namespace blendwright {

/// The fitted blend with columns u, v, gap, angle_deg, curvature_jump, mean_curvature, gaussian_curvature and
/// fit_deviation (distance to the exact blend at equal parameters). The three joint errors are known along
/// the trimlines; between them they run linearly from one side's value to the other's.
[[nodiscard]] TriMesh blend_mesh(const BlendResult& blend, LengthUnit unit);

/// Both trimlines with v, gap, angle_deg, curvature_jump along them.
[[nodiscard]] std::array<PolyLine, 2> trimline_lines(const BlendResult& blend, LengthUnit unit);

/// Adds gap, angle_deg and curvature_jump to a trimmed primary's mesh: at each point the error of the nearest
/// place of the given lines.
void add_seam_errors(TriMesh& mesh, const std::vector<PolyLine>& lines, LengthUnit unit);

/// How each blend was generated, in one line: "fillet: chord mode, tension1 with tension 2"; recorded in
/// every output.
[[nodiscard]] std::string shape_note(const JobResult& result);

/// The result as patches to be assembled; one patch per primary that is used, cut at all its trimlines.
[[nodiscard]] Assembly assembly_of(const JobResult& result);

}  // namespace blendwright
