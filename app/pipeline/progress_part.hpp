#pragma once
// A stage of a longer run as a part of its progress.
#include "kernel/base/progress.hpp"

namespace blendwright {

/// Fractions 0 to 1 of the stage are `lo` to `hi` of the run.
[[nodiscard]] inline Progress part_of(const Progress& progress, double lo, double hi) {
  return {[=, report = progress.report](double fraction, std::string_view stage) {
            report(lo + (hi - lo) * fraction, stage);
          },
          progress.stop};
}

}  // namespace blendwright
