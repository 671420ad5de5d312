#pragma once
// STEP out and in, with names, colours and units.
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/brep/extrema.hpp"
#include "kernel/brep/shape.hpp"

namespace blendwright {

enum class StepSchema { AP214, AP242 };
[[nodiscard]] const char* name(StepSchema s);

struct StepOptions {
  StepSchema schema = StepSchema::AP242;
  LengthUnit unit = LengthUnit::millimetre;
  std::string product = "blend";
  std::string note{};  ///< how it was made: the header's description
};

/// Writes to a temporary file in the same folder and renames; the time stamp comes from SOURCE_DATE_EPOCH
/// when set. Throws IoError (where, why); nothing is left under `file` then.
void write_step(const std::filesystem::path& file, const Shape& shape, const StepOptions& options);

/// One face as it came back.
struct StepFace {
  std::string name;
  Surface surface;  ///< location applied, in the file's own parameters (so that they can be compared with
                    ///< what was written); B-splines come back as BSplineSurface
  bool reversed = false;  ///< the outward normal of the face is -(Su x Sv)
  std::optional<Colour> colour;
  std::size_t control_points = 0;
  std::optional<ExtremaSurface> extrema{};  ///< the CAD kernel's geometry itself, in the same parameters
};
struct StepContent {
  std::vector<StepFace> faces;  ///< in the order of the file
  ShapeCheck check;
  std::string schema, unit;  ///< as the file states them: "AP242_MANAGED_...", "mm"
  std::size_t bytes = 0;
};
[[nodiscard]] StepContent read_step(const std::filesystem::path& file,
                                    LengthUnit unit = LengthUnit::millimetre);

}  // namespace blendwright
