#pragma once
// The primaries of a job: surfaces by name, STEP parts read once.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/pipeline/job.hpp"

namespace blendwright {

/// A primary ready for use. STEP faces keep their part, so that trimlines can be taken from its edges.
struct BuiltPrimary {
  std::string name;
  Surface surface;
  std::optional<StepPart> part;
  std::size_t face = 0;
  RigidMotion placement;
};

/// Throws InputError with the problems of all primaries ("/primaries/<name>/...").
[[nodiscard]] std::vector<BuiltPrimary> build_primaries(const JobSpec& job);

/// A trimline on its primary; `keep` is the side that the part's own face keeps, for lines taken from STEP
/// edges.
struct BuiltTrimline {
  Trimline line;
  std::optional<SideSpec::Keep> keep;
  double edge_deviation = 0.0;
};

/// Throws InputError and GeometryError with `pointer` ("/blends/<name>/from/trimline") in front.
[[nodiscard]] BuiltTrimline build_trimline(const TrimlineSpec& spec, const BuiltPrimary& primary,
                                           const std::map<std::string, double>& constants,
                                           const std::string& pointer);

}  // namespace blendwright
