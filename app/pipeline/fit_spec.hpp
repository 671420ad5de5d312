#pragma once
// "fit" of a blend in a job: what is wanted of its shape, and what may change for it.
#include <string>
#include <vector>

#include "app/pipeline/job.hpp"
#include "parametric/shape_fit/shape_fit.hpp"

namespace blendwright {

struct FitSpec {
  /// Obstacles and scanned points are not there yet: they are in files, which only a fit reads.
  ShapeFitOptions options{};
  /// One per objective: "scan.csv", "obstacle.stl" or "scene.json#node", relative to the job file's folder;
  /// empty where the objective needs none.
  std::vector<std::string> files{};
};

}  // namespace blendwright
