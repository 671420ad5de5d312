#pragma once
// The two pictures of a job: the blend coloured by its error, and the errors along the trimlines.
#include <vector>

#include "app/pipeline/run_job.hpp"
#include "kernel/exchange/picture.hpp"

namespace blendwright {

[[nodiscard]] Picture error_picture(const JobResult& result, const std::vector<TriMesh>& blends,
                                    const std::vector<TriMesh>& primaries,
                                    const std::vector<PolyLine>& lines);
/// Gap, angle and curvature jump along v, one plot each, both sides of every blend, with the tolerance.
[[nodiscard]] std::vector<Plot> error_plots(const JobResult& result);

}  // namespace blendwright
