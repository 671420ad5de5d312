#pragma once
// Whether bodies touch: as they stand, or along a motion.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/pipeline/bodies.hpp"
#include "app/pipeline/motion_file.hpp"
#include "app/pipeline/stage_time.hpp"
#include "app/pipeline/staging.hpp"
#include "implicit/relations/collision.hpp"
#include "implicit/relations/moving_bodies.hpp"

namespace blendwright {

struct CollideJob {
  SearchOptions search{};
  std::optional<int> projected{};                ///< axis of the bars; none: boxes of space
  const Motion* motion = nullptr;                ///< none: the bodies stand
  bool all = false;                              ///< of a motion: keep the disjoint pairs too
  std::vector<std::filesystem::path> cells{};    ///< .vtu or .png: the subdivision; two bodies that stand
  std::vector<std::filesystem::path> outputs{};  ///< .csv
  bool overwrite = false;
};

struct CollideStep {
  double at = 0.0;
  std::vector<BodyPair> pairs;  ///< of a motion: those that are not disjoint, or all whose bounds meet
};

struct CollideResult {
  std::vector<CollideStep> steps;      ///< one when the bodies stand
  Contact answer = Contact::disjoint;  ///< contact when any pair is, else undecided when any pair is
  std::size_t contacts = 0, undecided = 0, boxes = 0;  ///< pairs of all steps; boxes of the pairs kept
  std::vector<WrittenFile> files{};
  std::vector<std::string> notes{};
  std::vector<StageTime> times{};
};

/// All files appear together or none does. Throws InputError ("--cells", "--output", "--domain", ...),
/// IoError, Cancelled.
[[nodiscard]] CollideResult run_collide_job(std::span<const Body> bodies, const CollideJob& job,
                                            const Progress& progress = {});

/// Lines of comma separated values; the first column only with a motion. What is not known is empty.
[[nodiscard]] std::string collision_csv(std::span<const Body> bodies, const CollideJob& job,
                                        const CollideResult& result);
/// The report as JSON text; clock readings only when `times`.
[[nodiscard]] std::string collision_report_json(std::span<const Body> bodies, const CollideJob& job,
                                                const CollideResult& result, bool times);

}  // namespace blendwright
