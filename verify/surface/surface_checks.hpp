#pragma once
// Checks of the blend as a surface: folds, smallest radius, penetration of the primaries, self-intersection, closing seam.
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

/// |Su x Sv| relative to the product of the mean lengths, and normals that turn by more than 90 deg between neighbours
/// of the sampling grid: a fold or a crease.
struct FoldReport {
  Extreme smallest_area;        ///< least |Su x Sv| / (mean |Su| mean |Sv|)
  std::size_t folded = 0;       ///< neighbouring samples whose normals differ by more than 90 deg
  Extreme where;                ///< the worst of them: value = angle in radians
};
[[nodiscard]] FoldReport check_fold(const Surface& blend, int nu = 48, int nv = 192);

/// Smallest radius of curvature 1/max(|k1|, |k2|), refined to a local minimum.
[[nodiscard]] Extreme minimum_radius(const Surface& blend, int nu = 48, int nv = 192);

/// Does the blend cross a primary? The side that counts as outside is the one where the blend's far end lies; value is
/// the largest depth on the other side (0 when none), over samples whose foot is inside the primary's domain.
struct PenetrationReport {
  bool judged = true;           ///< false: the far end lies on both sides of the primary
  Extreme depth;
};
[[nodiscard]] PenetrationReport check_penetration(const Surface& blend, int primary_side, const Surface& primary,
                                                  int nu = 32, int nv = 96);

/// Sampled: triangles of a mesh of the blend that cross without being neighbours (bounding-volume tree).
struct SelfIntersectionReport {
  std::size_t pairs = 0;
  Extreme where;
};
[[nodiscard]] SelfIntersectionReport check_self_intersection(const Surface& blend, int nu = 32, int nv = 128);

/// Closed blends: largest mismatch of S, of the tangent plane and of the normal curvature along v across v.lo = v.hi.
struct ClosingReport {
  double gap = 0.0;
  Radians angle;
  double curvature = 0.0;
  double u = 0.0;               ///< where the worst is
};
[[nodiscard]] ClosingReport check_closing(const Surface& blend, int nu = 64);

}  // namespace blendwright
