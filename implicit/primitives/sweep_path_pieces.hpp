#pragma once
// From formulas to the pieces of a path.
#include "implicit/primitives/sweep_path.hpp"

namespace blendwright::detail {

/// Most pieces of one path.
inline constexpr std::size_t most_pieces = 100000;

/// Pieces without frames, from t0 to t1. Throws InputError as Path does.
[[nodiscard]] std::vector<PathPiece> path_pieces(const std::vector<std::string>& formulas, double t0,
                                                 double t1);
/// Sets e and theta so that U at x = -1 is this direction.
void add_frame(PathPiece& piece, const Vec3& U);

}  // namespace blendwright::detail
