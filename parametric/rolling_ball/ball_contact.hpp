#pragma once
// A ball that touches two primaries, and the corrector that puts it there. Private to this module.
//
// Signed radii r_i, |r_1| = |r_2|; E_i(c) = (c - p_i(c)).n_i - r_i = 0, grad E_i = n_i (1) shortest
// correction: c -= N^T (N N^T)^-1 E, N = [n_1; n_2]                                                (2) T =
// n_1 x n_2/|n_1 x n_2|                                                                                 (3)
#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "parametric/rolling_ball/ball_primary.hpp"
#include "parametric/rolling_ball/spine.hpp"

namespace blendwright {

/// Normals count as parallel from 1 - |n1.n2| <= this.
inline constexpr double parallel_normals = 1e-10;

struct BallContact {
  Vec3 c;
  std::array<BallFoot, 2> feet;
};

/// Largest |E_i| that counts as touching.
[[nodiscard]] inline double touching(const BallPair& pair) {
  return 1e-12 * std::max(1.0, std::abs(pair.radius[0]));
}

/// A contact, or what keeps the ball from it.
using Corrected = std::variant<BallContact, BallFailure::Cause>;

/// Feet of c, warm-started.
[[nodiscard]] Corrected feet_of(const BallPair& pair, const Vec3& c, const std::array<BallFoot, 2>& near);

/// (2) from c.
[[nodiscard]] Corrected corrected(const BallPair& pair, const Vec3& c, const std::array<BallFoot, 2>& near,
                                  int max_iterations);

/// The ball that touches both with its centre in the plane (c - origin).normal = 0: Newton from c.
[[nodiscard]] Corrected corrected_in_plane(const BallPair& pair, const Vec3& c, const Vec3& origin,
                                           const Vec3& normal, const std::array<BallFoot, 2>& near);

/// Largest |E_i|.
[[nodiscard]] double residual(const BallPair& pair, const BallContact& contact);

/// 1 - |n1.n2| <= limit, without the cancellation of that difference.
[[nodiscard]] bool parallel(const BallContact& contact, double limit);

/// T of (3); zero where the normals are parallel.
[[nodiscard]] Vec3 spine_tangent(const BallContact& contact);

/// Curvature of the spine, |dT/ds|, from the turning of both normals.
[[nodiscard]] double spine_curvature(const BallContact& contact);

}  // namespace blendwright
