#pragma once
// Where surfaces stand: along rays, over directions, around an axis.
#include <span>
#include <vector>

#include "tests/implicit/scenes/example_scene.hpp"

namespace blendwright::test {

/// For every direction (unit vectors) the distance from `from` at which `depth` changes sign, to rounding. It
/// must be positive next to `from` and not positive at `reach`, else std::runtime_error; where it changes
/// sign more than once, one of the places is found.
[[nodiscard]] std::vector<double> radii(const PointFunction& depth, const Vec3& from,
                                        std::span<const Vec3> directions, double reach);
[[nodiscard]] double radius(const PointFunction& depth, const Vec3& from, const Vec3& direction,
                            double reach);

/// Radii of the section at height z around the z axis, at `count` even angles from 0 on.
[[nodiscard]] std::vector<double> section(const PointFunction& depth, double z, int count, double reach);
/// Number of maxima of a periodic sequence that stand out by more than `prominence`.
[[nodiscard]] int count_maxima(std::span<const double> periodic, double prominence);
/// Area of the star-shaped plane region with these radii at even angles.
[[nodiscard]] double area(std::span<const double> radii);

/// A local maximum of a function of directions.
struct Peak {
  Vec3 direction = Vec3::Zero();
  double height = 0.0;
};
/// The local maxima that stand alone: higher than everything 0.02 rad around them. Found from 10,242 even
/// directions, each maximum among its neighbours refined to 1e-8 rad.
[[nodiscard]] std::vector<Peak> isolated_maxima(const PointFunction& height);
/// The highest and lowest of all values over directions.
[[nodiscard]] Peak highest(const PointFunction& height);
[[nodiscard]] Peak lowest(const PointFunction& height);

}  // namespace blendwright::test
