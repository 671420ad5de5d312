#pragma once
// Blend and primaries as the CAD kernel knows them: what the second path of the verifier measures on.
#include "kernel/exchange/step_file.hpp"
#include "verify/report/blend_report.hpp"

namespace blendwright {

/// Of surfaces in memory.
[[nodiscard]] BlendUnderTest::Second second_surfaces(const BlendUnderTest& under_test);
/// Of the STEP file read back: the blend's face and, for distances, the faces of the primaries, which are
/// known by their names. Other primaries than the CAD kernel has are splines there, within `approximation`.
[[nodiscard]] BlendUnderTest::Second second_surfaces(const BlendUnderTest& under_test, const StepFace& blend,
                                                     const StepContent& content,
                                                     const std::array<std::string, 2>& primaries,
                                                     double approximation);

}  // namespace blendwright
