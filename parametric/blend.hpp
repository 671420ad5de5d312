#pragma once
// From a blend's specification to its exact surface: the one entry to this module.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "parametric/cross_tangent/cross_tangent.hpp"
#include "parametric/ode/ode_blend.hpp"
#include "parametric/trimline/correspondence.hpp"

namespace blendwright {

/// A blend between two trimlines on primaries.
struct BlendSpec {
  std::array<SideSpec, 2> sides{};
  CorrespondenceSpec correspondence{};
  BlendShape shape{};
};

struct Blend {
  OdeBlend surface;
  std::array<std::optional<Trimline>, 2>
      trimlines;  ///< on the blend's v; empty for literal boundary data without one
  std::optional<Correspondence> correspondence;
  std::optional<CrossTangents> tangents;
  /// One sentence each: kappa > 1e3 (wild shape), a cross tangent within asin(0.1) of its trimline, harmless
  /// degenerate points, a place where literal data have |C'| = 0, connecting lines twisted by more than 75
  /// deg.
  std::vector<std::string> warnings;
};

/// Throws GeometryError (its message begins with "from: " or "to: " when it is about one side; also when a
/// trimline crosses or overlaps itself, and at a trimline's corner: a degenerate point whose normal or
/// tangent limits differ by more than 1e-6 rad), InputError (where: "sides/0/...", "correspondence/...",
/// "shape/..."), ResonanceError.
[[nodiscard]] Blend make_blend(const Trimline& line0, const Trimline& line1, const BlendSpec& spec,
                               double tolerance);
/// From boundary data typed as formulas. `lines` (on the same v) only serve the trimmed primaries and the
/// checks.
[[nodiscard]] Blend make_literal_blend(const EndCondition& end0, const EndCondition& end1,
                                       const BlendShape& shape,
                                       std::array<std::optional<Trimline>, 2> lines = {});

}  // namespace blendwright
