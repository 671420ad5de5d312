#pragma once
// "fit" of a blend, and objectives typed on a command line.
#include <string>
#include <vector>

#include "app/json/object_reader.hpp"
#include "app/pipeline/fit_spec.hpp"

namespace blendwright {

/// Every problem goes to `reading`; the result is only meaningful when there is none.
[[nodiscard]] FitSpec read_fit(const JsonValue& value, const std::string& where, Reading& reading);

/// "thin_plate", "rolling_ball=2", "clearance=0.5,obstacle.stl": a kind and what it cannot do without.
/// Throws InputError under `where`.
struct TypedObjective {
  FitObjective objective;
  std::string file;  ///< as of FitSpec::files
};
[[nodiscard]] TypedObjective typed_objective(const std::string& text, const std::string& where);

}  // namespace blendwright
