#pragma once
// Profiles: star-shaped plane curves with a gauge, the cross-sections of bars and sweeps.
//
//   g(u, v) = r q(theta),  r = sqrt(u^2 + v^2),  theta = atan2(v, u),  q = 1/rho                          (1)
//   lp    g = N_n(|u/a|, |v/b|)                                     a, b, n > 0                           (2)
//   rose  rho = a (1 + eps cos k theta) / (1 + eps)                 a > 0, k >= 2 whole, 0 <= eps < 1     (3)
//   star  rho = a / (1 + sigma |sin(k theta / 2)|^m)                a, sigma > 0, k >= 2 whole, m >= 1    (4)
//
// g = 1 is the profile itself; rho: its radius (model units). g is 0 at the axis r = 0 with derivatives 0. A
// star with m = 1 has sharp tips: there the derivative of q counts as 0. (2): Blanc and Schlick 1995; (3),
// (4): polar cross-sections after the spherical product of Hsu 2012, as defined here.
#include <limits>
#include <optional>

#include "implicit/number/power.hpp"
#include "kernel/field/range.hpp"

namespace blendwright::detail {

/// Largest k of (3) and (4).
inline constexpr int most_lobes = 64;

struct Profile {
  enum class Kind { lp, rose, star };
  Kind kind = Kind::lp;
  double a = 1.0, b = 1.0;  ///< b: lp only
  Power n{2.0}, inverse_n{0.5};
  int k = 2;
  double eps = 0.0, sigma = 1.0;
  Power m{1.0};

  [[nodiscard]] static Profile lp(double a, double b, double n);
  [[nodiscard]] static Profile rose(int k, double a, double eps);
  [[nodiscard]] static Profile star(int k, double a, double sigma, double m);

  /// Radii of g = 1: its smallest, its largest.
  [[nodiscard]] Range radius() const;
  /// Encloses |u| and |v| of g <= 1.
  [[nodiscard]] std::pair<double, double> extent() const;
  /// |g(P) - g(Q)| <= lipschitz() |P - Q|; infinite for an lp profile with n < 1.
  [[nodiscard]] double lipschitz() const;
  /// Whether g stays the same under a turn by this angle.
  [[nodiscard]] bool same_after_turn(double angle) const;
  /// g at one point, through the same formula as every kernel; and its partials.
  [[nodiscard]] double gauge(double u, double v) const;
  struct Slopes {
    double value, by_u, by_v;
  };
  [[nodiscard]] Slopes slopes(double u, double v) const;
};

/// A part of the profile's plane: a box around it, and its polar coordinates.
struct PlanePart {
  Range u, v;
  Range r;
  std::optional<Range> theta;                          ///< in [lo, hi] with hi - lo < 2 pi; none: every angle
  double centre_u = 0.0, centre_v = 0.0, reach = 0.0;  ///< a disk around it
};
/// The box u x v.
[[nodiscard]] PlanePart plane_box(Range u, Range v);
/// The disk around (u, v).
[[nodiscard]] PlanePart plane_disk(double u, double v, double radius);

/// The angles of the box, from (-pi, pi] on and less than pi wide; none when it holds the origin.
[[nodiscard]] std::optional<Range> angles(Range u, Range v);

/// Encloses 1/rho over these angles (all when there are none).
[[nodiscard]] Range reciprocal_radius_range(const Profile& profile, const std::optional<Range>& theta);
/// Encloses cos over [lo, hi].
[[nodiscard]] Range cosine_range(Range x);
/// Encloses r times the second derivative of g across the ray, q + q'' (3), (4), over these angles; none of a
/// star with m < 2 near a tip.
[[nodiscard]] std::optional<Range> bend_range(const Profile& profile, Range theta);
/// Encloses g over the part turned by every -phi, phi in `turn`. Tends to the exact range as part and turn
/// shrink to a point.
[[nodiscard]] Range gauge_range(const Profile& profile, const PlanePart& part, Range turn = {0.0, 0.0});

}  // namespace blendwright::detail
