#pragma once
// Which point of trimline 0 is joined to which point of trimline 1.
#include <optional>

#include "parametric/trimline/trimline.hpp"

namespace blendwright {

enum class CorrespondenceRule {
  as_given,      ///< both lines keep their parameter, mapped to a common range
  arc_length,    ///< normalised arc length on both (default)
  minimal_twist  ///< arc length on line 0; line 1 by a monotone map that minimises int |d(De/|De|)/dv|^2
};

struct CorrespondenceSpec {
  CorrespondenceRule rule = CorrespondenceRule::arc_length;
  std::optional<bool> reverse;         ///< nullopt: decided (signed area vectors, else the cheaper of both)
  std::optional<double> seam_offset;   ///< closed lines, as a fraction of the period of line 1; nullopt: minimal distance
};

struct Correspondence {
  Trimline line0, line1;   ///< on the common range
  bool reversed = false;
  double seam_offset = 0.0;
  double twist = 0.0;      ///< largest angle between De and its neighbours' mean direction per unit of v, radians
};

/// Closed with closed, open with open; anything else is a GeometryError. The common range is [0, 1] for arc_length and
/// minimal_twist, and line 0's own range for as_given.
[[nodiscard]] Correspondence correspond(const Trimline& line0, const Trimline& line1, const CorrespondenceSpec& spec);

}  // namespace blendwright
