#pragma once
// The shape of any STEP file, to be shown.
#include <filesystem>
#include <vector>

#include "kernel/brep/shape.hpp"

namespace blendwright {

struct StepShape {
  Shape shape;
  std::vector<Surface> surfaces;  ///< of the shape's faces, in its order and the CAD kernel's own parameters
};
/// All shapes of the file as one. Throws IoError.
[[nodiscard]] StepShape read_step_shape(const std::filesystem::path& file,
                                        LengthUnit unit = LengthUnit::millimetre);

}  // namespace blendwright
