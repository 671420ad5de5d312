#pragma once
// Continuity of a blend with its primary along one trimline, measured on surfaces alone: nothing here knows how the
// blend was made.
//
//   gap(v)       = |S(u_side, v) - C(v)|, C the trimline on the primary; also the distance to the primary surface    (1)
//   angle(v)     = atan2(|nS x nP|, |nS.nP|) in [0, 90 deg]                                                         (2)
//   curvature(v) = |kS(t) - kP(t)|, normal curvatures in one direction t transversal to the trimline, both against the
//                  normal of the primary (Pegna and Wolter: with equal tangent planes this is G2)                    (3)
//   fold(v)      = the blend leaves the trimline on the kept side instead of away from it: Su . k has the wrong sign (4)
//   transverse(v)= |Su x C'| / (|Su| |C'|), warned below 0.1                                                        (5)
// Units: model units, radians, 1/model unit.
#include <optional>
#include <string>
#include <vector>

#include "kernel/base/progress.hpp"
#include "kernel/geometry/curve.hpp"
#include "kernel/geometry/surface.hpp"

namespace blendwright {

/// Largest and root-mean-square value and the place of the largest.
struct Deviation {
  double worst = 0.0, rms = 0.0;
  double v = 0.0;        ///< parameter along the trimline
  Vec3 point = Vec3::Zero();
};

/// One joint to be measured.
struct Seam {
  std::string name;                ///< e.g. "fillet/from"
  Surface blend;
  int side = 0;                    ///< 0: the edge u = lo, 1: the edge u = hi of the blend
  std::optional<Surface> primary;  ///< empty: only position against `pcurve`-less data cannot be measured
  std::optional<Curve2> pcurve;    ///< the trimline on the primary, on the blend's v; empty: closest points are searched
  bool kept_left = true;           ///< the kept part of the primary lies towards n x C'
};

struct SeamReport {
  std::string name;
  std::size_t samples = 0;
  Deviation gap;             ///< (1) to the trimline; to the primary where no trimline was given
  Deviation surface_gap;     ///< distance to the primary surface
  Deviation angle;           ///< (2), radians
  Deviation curvature;       ///< (3)
  Deviation transverse;      ///< (5): `worst` is the smallest value
  std::size_t folded = 0;    ///< samples that fold (4)
  std::vector<double> v, gap_at, angle_at, curvature_at;  ///< for plots and files, in order of v
};

struct SeamOptions {
  int samples = 2048;        ///< along v; places are never knots of a uniform spline (an irrational step is used)
  bool refine = true;        ///< each sampled maximum is refined to a local maximum by golden section
};

/// Never throws because the geometry is bad: bad geometry is the result (NaN counts as worst).
[[nodiscard]] SeamReport check_seam(const Seam& seam, const SeamOptions& options = {}, const Progress& progress = {});

/// The verdict, recomputable from the report and the tolerance; NaN and no samples fail, a fold is at most G0.
[[nodiscard]] Continuity reached(const SeamReport& report, const Tolerance& tolerance);

}  // namespace blendwright
