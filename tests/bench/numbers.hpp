#pragma once
// Random numbers of splitmix64: the same everywhere.
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "kernel/base/units.hpp"

namespace blendwright::bench {

struct Numbers {
  std::uint64_t state;
  /// In [0, 1): the top 53 bits.
  double next() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
  }
  double uniform(double lo, double hi) { return lo + (hi - lo) * next(); }
  Vec3 vector(double reach) {
    const double x = uniform(-reach, reach), y = uniform(-reach, reach);
    return {x, y, uniform(-reach, reach)};
  }
  Vec3 direction() {
    const double z = uniform(-1.0, 1.0), t = 2.0 * std::numbers::pi * next(), r = std::sqrt(1.0 - z * z);
    return {r * std::cos(t), r * std::sin(t), z};
  }
  /// Even among all rotations (Shoemake 1992).
  Eigen::Matrix3d turn() {
    const double u = next(), v = 2.0 * std::numbers::pi * next(), w = 2.0 * std::numbers::pi * next();
    const double a = std::sqrt(1.0 - u), b = std::sqrt(u);
    return Eigen::Quaterniond(b * std::cos(w), a * std::sin(v), a * std::cos(v), b * std::sin(w))
        .toRotationMatrix();
  }
};

}  // namespace blendwright::bench
