#pragma once
// Differential geometry of a surface point, from its second-order jet.
//
// E = Su.Su, F = Su.Sv, G = Sv.Sv;  n = Su x Sv / |Su x Sv|;  L = Suu.n, M = Suv.n, N = Svv.n          (1)
// K = (LN - M^2)/(EG - F^2),  H = (EN - 2FM + GL)/(2(EG - F^2))                                          (2)
// normal curvature in the direction a Su + b Sv: (a^2 L + 2ab M + b^2 N)/(a^2 E + 2ab F + b^2 G)         (3)
// Curvatures in 1/model unit; signs belong to n. Source: do Carmo, Differential Geometry of Curves and
// Surfaces, ch. 3.
#include "kernel/geometry/surface.hpp"

namespace blendwright {

/// Unit normal; zero vector where |Su x Sv| <= 1e-14 |Su| |Sv| (a pole or a cusp).
[[nodiscard]] Vec3 unit_normal(const SurfaceJet& jet);

struct SurfaceCurvature {
  double mean = 0.0, gaussian = 0.0;
  double k_min = 0.0, k_max = 0.0;  ///< principal curvatures, k_min <= k_max
};
/// NaN in every field where the surface is degenerate.
[[nodiscard]] SurfaceCurvature curvature(const SurfaceJet& jet);

/// Normal curvature (3) in the tangent direction nearest to `direction` (its normal part is dropped), with
/// respect to the unit normal `n` given by the caller, so that both sides of a joint can be measured against
/// one normal.
[[nodiscard]] double normal_curvature(const SurfaceJet& jet, const Vec3& direction, const Vec3& n);

/// Angle between two tangent planes in [0, pi/2], from the unsigned normals: atan2(|n1 x n2|, |n1.n2|).
[[nodiscard]] Radians plane_angle(const Vec3& n1, const Vec3& n2);

}  // namespace blendwright
