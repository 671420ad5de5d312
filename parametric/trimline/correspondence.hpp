#pragma once
// Which point of trimline 0 is joined to which point of trimline 1.
//
// De = C1 - C0.  N_i = 1/2 int C_i x C_i' dv, the signed area vector of a closed line (1) J(o) = int |C1(o +-
// x) - C0(x)|^2 dx, the cost of a seam offset o and a direction                            (2) A line is
// reversed when N_0.N_1 < 0; when |N_0.N_1| < 0.1 |N_0||N_1|, and on open lines always, when J is less that
// way. The seam offset minimises J: the best of 256 steps, then Newton.
#include <optional>
#include <vector>

#include "parametric/trimline/trimline.hpp"

namespace blendwright {

/// One value of a law along v: at the fraction t in [0, 1] of the range.
struct LawPoint {
  double t = 0.0, value = 1.0;
};

enum class CorrespondenceRule {
  as_given,    ///< both lines keep their parameter, mapped to a common range; not reversed or shifted unless
               ///< asked
  arc_length,  ///< normalised arc length on both (default)
  minimal_twist,  ///< arc length on line 0; line 1 by a monotone map that minimises int |d(De/|De|)/dv|^2
  mapped          ///< arc length on line 0; line 1 by the map given as `map`
};

struct CorrespondenceSpec {
  CorrespondenceRule rule = CorrespondenceRule::arc_length;
  /// Whether line 1 is run through backwards; nullopt: decided by (1), else by (2).
  std::optional<bool> reverse{};
  /// Closed lines: the start of line 0 is joined to the point of line 1 at this fraction of its period,
  /// counted along line 1 as given (also when it is reversed); nullopt: minimal distance (2).
  std::optional<double> seam_offset{};
  /// Rule mapped: `value` is the fraction of the length of line 1, arranged by `reverse` and `seam_offset`,
  /// that is joined to the fraction t of line 0. Between the points runs a quintic spline (C4), which must
  /// increase. Open lines: (0, 0) and (1, 1) are implied. Closed lines: periodic, g(t + 1) = g(t) + 1; t in
  /// [0, 1), values may run beyond [0, 1], and a single point is a shift.
  std::vector<LawPoint> map{};
};

struct Correspondence {
  Trimline line0, line1;  ///< on the common range
  bool reversed = false;
  double seam_offset = 0.0;  ///< in [0, 1)
  /// Largest angle, over v, between De and the plane of C0' and C1', weighted by their own angle:
  /// asin(|det(De, C0', C1')| / (|De| |C0'| |C1'|)), radians; 0 for a developable strip.
  double twist = 0.0;
};

/// Closed with closed, open with open; anything else is a GeometryError, also a line that stops (|C'| = 0)
/// under the arc length rules. InputError: a seam offset for open lines, or one that is not finite; a map
/// without the rule mapped and the rule without a map; a map that does not increase ("map", "map/1"). The
/// common range is line 0's own for as_given, else [0, 1].
[[nodiscard]] Correspondence correspond(const Trimline& line0, const Trimline& line1,
                                        const CorrespondenceSpec& spec);

}  // namespace blendwright
