#pragma once
// How far an offset solid is from the exact one.
#include <span>

#include "kernel/field/scalar_field.hpp"

namespace blendwright {

/// From points P of the original surface with the outward normal n: e is the root nearest 0 of the offset's
/// phi(P + distance n + e n), looked for in |e| <= 0.9 |distance|. e > 0: the offset is too large.
struct OffsetError {
  double worst = 0.0;  ///< the e with the largest |e| (model units)
  double rms = 0.0;
  Vec3 where = Vec3::Zero();     ///< P + distance n of the worst
  std::size_t samples = 0;       ///< points with a normal
  std::size_t without_root = 0;  ///< of them: there is no root; in the exact offset they may be trimmed away
};

/// `surface`: points on the surface of `original`. Throws InputError ("distance": 0 or not finite, "points").
[[nodiscard]] OffsetError offset_error(const ScalarField& original, const ScalarField& offset,
                                       double distance, std::span<const Vec3> surface);

}  // namespace blendwright
