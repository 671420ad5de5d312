#pragma once
// Checks of the blend as a surface: folds, smallest radius, penetration of the primaries, self-intersection,
// closing seam. All are sampled; a grid of nu x nv cells has (nu + 1)(nv + 1) samples, ends included, with
// steps that vary irrationally by a few percent: a crossing of a symmetric surface must not hide on a line of
// the grid. None throws because the geometry is bad, and a value that is not a number stays one: NaN fails
// when judged.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "kernel/base/progress.hpp"
#include "kernel/geometry/surface.hpp"

namespace blendwright {

/// A value and where on the blend it is attained.
struct Extreme {
  double value = 0.0;
  UV at;
  Vec3 point = Vec3::Zero();
};

/// Does the surface have a normal everywhere, and does it keep its side?
struct FoldReport {
  Extreme smallest_area;  ///< least |Su x Sv| / (mean |Su| mean |Sv|); the borders u = lo, hi are left to the
                          ///< seams
  std::size_t folded =
      0;          ///< places between neighbouring samples where the normal turns by more than 90 deg at once,
                  ///< confirmed by bisection to a thousandth of the cell: a fold or a crease
  Extreme where;  ///< the sharpest turn between neighbours: value = angle in radians
};
[[nodiscard]] FoldReport check_fold(const Surface& blend, int nu = 24, int nv = 128);

/// Smallest radius of curvature 1/max(|k1|, |k2|), refined to a local minimum; infinite for a plane. Places
/// without a normal are skipped; NaN when there is no other.
[[nodiscard]] Extreme minimum_radius(const Surface& blend, int nu = 24, int nv = 128);

/// Does the blend cross a primary? Signed distances from the primary are taken at the samples whose closest
/// point lies inside the primary's domain; the whole domain counts, the part that the trimline cuts away too.
/// "Outside" is the side where the blend's far end lies (the row of samples farthest from the joint that has
/// such samples off the surface). The depth is the largest distance on the other side, refined; 0 when
/// nothing lies there.
struct PenetrationReport {
  bool judged = true;  ///< false: that row lies on both sides of the primary, so neither side is outside
  Extreme depth;
};
/// `primary_side` 0: the primary joins the edge u = lo of the blend, 1: u = hi.
[[nodiscard]] PenetrationReport check_penetration(const Surface& blend, int primary_side,
                                                  const Surface& primary, int nu = 12, int nv = 64);

/// Triangles of a mesh of the blend that pass through each other. Triangles of the same or of neighbouring
/// cells are not compared (their trouble is a fold), and a mere touch does not count. O(n log n) in the
/// number of triangles.
struct SelfIntersectionReport {
  std::size_t pairs = 0;  ///< of triangles
  Extreme where;  ///< the deepest: value = how far an edge reaches beyond the other triangle, model units
  UV other;       ///< the other place of the blend that passes there
};
[[nodiscard]] SelfIntersectionReport check_self_intersection(const Surface& blend, int nu = 24, int nv = 128);

/// Closed blends: largest mismatch across v.lo = v.hi of S, of the tangent plane, and of the normal curvature
/// across that line (against one normal). Both sides are limits from inside, so a parameter that wraps hides
/// nothing.
struct ClosingReport {
  double gap = 0.0;
  Radians angle;
  double curvature = 0.0;
  double u = 0.0;  ///< where the largest gap is; where the largest angle is when the gaps are all below 1e-9
                   ///< of the size
  Vec3 point = Vec3::Zero();
};
[[nodiscard]] ClosingReport check_closing(const Surface& blend, int nu = 64);

}  // namespace blendwright
