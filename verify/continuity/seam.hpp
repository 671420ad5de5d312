#pragma once
// Continuity of a blend with its primary along one trimline, measured on surfaces alone: nothing here knows
// how the blend was made.
//
// S, nS  blend and its normal at the edge u = u_side;  P, nP  primary and its normal at the trimline, C(v) =
// P(pcurve(v)) k      the conormal of the trimline that points into the kept part of the primary, along +-(nP
// x C')
//
//   gap(v)       = |S(u_side, v) - C(v)|, and the distance of S(u_side, v) to the primary surface (1)
//   angle(v)     = atan2(|nS x nP|, |nS.nP|) in [0, 90 deg]; atan2, because acos cannot see below 1.5e-8 rad
//   (2) curvature(v) = |kS(t) - kP(t)|, normal curvatures in the one direction t = nP x C', both signed by
//   nP, so that the
//                  orientations of the two surfaces do not matter. With equal tangent planes, 0 is G2 (Pegna
//                  and Wolter 1992, linkage curve theorem), and no other direction shows a larger jump (3)
//   fold(v)      = d.k / (|d| |k|), d = the direction in which the blend leaves the trimline (Su on side 0,
//   -Su on
//                  side 1): -1 is straight away from the kept part, positive is back over it, a cuspidal fold
//                  even though the tangent planes agree (4)
//   transverse(v)= |Su x C'| / (|Su| |C'|) (5)
// Units: model units, radians, 1/model unit.
//
// Where the trimline has a cusp or a surface has no normal, (2)-(5) are taken a millionth of the domain
// further inside: the one-sided limit where there is one. NaN where there is none.
#include <optional>
#include <string>
#include <vector>

#include "kernel/base/progress.hpp"
#include "kernel/geometry/curve.hpp"
#include "kernel/geometry/surface.hpp"

namespace blendwright {

/// Worst and root-mean-square value and the place of the worst. NaN when any sample was NaN; the place is
/// then the first such sample.
struct Deviation {
  double worst = 0.0, rms = 0.0;
  double v = 0.0;  ///< parameter along the trimline
  Vec3 point = Vec3::Zero();
};

/// One joint to be measured.
struct Seam {
  std::string name{};  ///< e.g. "fillet/from"
  Surface blend;
  int side = 0;                      ///< 0: the edge u = lo, 1: the edge u = hi of the blend
  std::optional<Surface> primary{};  ///< empty: there is nothing to measure against
  std::optional<Curve2>
      pcurve{};           ///< trimline on the primary, on the blend's v; empty: closest points are searched
  bool kept_left = true;  ///< the kept part of the primary lies towards nP x C'
};

struct SeamReport {
  std::string name;
  bool measured = true;  ///< false: the seam has no primary
  std::size_t samples = 0;
  Deviation gap;           ///< (1) to the trimline; to the primary where no trimline was given
  Deviation surface_gap;   ///< (1) to the primary surface
  Deviation angle;         ///< (2)
  Deviation curvature;     ///< (3)
  Deviation transverse;    ///< (5): `worst` is the smallest value
  Deviation fold;          ///< (4): negative everywhere on a sound joint
  std::size_t folded = 0;  ///< samples that fold: (4) is positive
  std::vector<double> v, gap_at, angle_at, curvature_at;  ///< for plots and files, in order of v
};

struct SeamOptions {
  /// Along v: both ends, and between them equal steps shifted by the golden ratio, so that no sample is a
  /// knot of a uniform spline, where interpolation errors vanish.
  int samples = 2048;
  bool refine = true;  ///< each sampled worst is refined to a local maximum between its neighbours: golden
                       ///< section with parabolic steps, then Newton's method
};

/// Never throws because the geometry is bad: bad geometry is the result (NaN counts as worst). The same
/// report for any number of threads. Cost: one jet of the blend and one of the primary per sample; without a
/// pcurve a closest point.
[[nodiscard]] SeamReport check_seam(const Seam& seam, const SeamOptions& options = {},
                                    const Progress& progress = {});

/// The verdict, recomputable from the report and the tolerance; NaN and no samples fail, a fold is at most
/// G0.
[[nodiscard]] Continuity reached(const SeamReport& report, const Tolerance& tolerance);

}  // namespace blendwright
