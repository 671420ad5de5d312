#pragma once
// The section of a sweep: a profile in the normal plane of the trajectory, scaled and turned along it
// (Crespin, Blanc and Schlick 1996, as defined here).
//
//   (u, v) = (u0, v0) turned by -phi,   phi = twist k,   s = s0 + (s1 - s0) k (1) d = g(u, v)/s where the
//   foot lies inside the trajectory                        (2) d = N_m(g(u, v)/s, |alpha|/e)        where the
//   foot is an end and alpha != 0                          (3)
//
// (u0, v0): the point in the foot's normal plane; alpha: its offset along the tangent (model units); k in
// [0, 1]: how far along the foot is; g: gauge of the profile; s0, s1 > 0: scales of the profile's radius;
// twist (radians); e > 0: cap length (model units); m > 1. Across the end planes d is continuous; its
// gradient is too when s' = phi' = 0.
#include "implicit/number/power.hpp"
#include "implicit/primitives/profile.hpp"
#include "kernel/base/units.hpp"

namespace blendwright::detail {

struct Section {
  Profile profile;
  double s0 = 1.0, ds = 0.0;  ///< s1 = s0 + ds
  double twist = 0.0;
  double inverse_cap = 1.0;  ///< 1/e
  Power m, inverse_m;
  /// Whether (1) changes along the trajectory.
  [[nodiscard]] bool varies() const { return ds != 0.0 || twist != 0.0; }
  /// Whether the section is the same at k = 0 and 1.
  [[nodiscard]] bool closes() const { return ds == 0.0 && profile.same_after_turn(twist); }
  /// How far |(u0, v0)| reaches for d <= value over this part of the trajectory.
  [[nodiscard]] double reach(double value, Range k) const;
};

/// Encloses d for (u0, v0) in the part, these k (increasing beyond [0, 1] only if the section closes) and
/// |alpha|; alpha {0, 0}: (2).
[[nodiscard]] Range section_range(const Section& section, const PlanePart& part, Range k, Range alpha);

/// Encloses the part of d <= value that belongs to the end k = 0 or 1 with this tangent (unit).
[[nodiscard]] Box end_box(const Section& section, double k, const Vec3& end, const Vec3& tangent,
                          double value);

}  // namespace blendwright::detail
