#pragma once
// The largest or smallest value of any field within a ball, with a proof:
//   F(X) = max or min of f(Y), |Y - X| <= D                                                              (1)
// A sequence of quadratic models (ball_maximum.hpp) leads from the best of sixteen points to a local maximum
// v at Y*, to the last digits. A branch and bound then shows that no point of the ball is above
// v + tolerance * (range of f over the ball's box), or finds one, from where the search goes on. Cells are
// bounded by linear bounds of f with the ball as a Lagrange term,
//   f(Y) <= f(Y) + l (D^2 - |Y - X|^2), l >= 0,                                                           (2)
// l from Y*; around Y* cells are cubes, each half as large as the one before, so that the usual point costs a
// dozen bounds. Everything depends on X alone, in a fixed order. After most_cells cells the search gives up
// and F is the largest value found, a lower end (upper for min): in practice only where f has edges through
// Y*.
//   Ties: where several points are best, F is exact, its gradient that of f at the first found and its second
// derivatives those that belong to it.
//   Edges of f through Y* (the largest of a minimum): F is within the tolerance, its gradient has the right
// direction and about the right length, its second derivatives count as 0.
#include <memory>

#include "implicit/offset/local_points.hpp"

namespace blendwright::detail {

struct BallSearch {
  const ScalarField::Model* field;
  double radius, sign;  ///< sign: 1 for the largest value, -1 for the smallest
  double tolerance;     ///< relative, see above
};
inline constexpr std::size_t most_cells = 4000;

struct BallTop {
  PointJet f;  ///< F with its derivatives by X
  Vec3 at = Vec3::Zero();
  double upper = 0.0;      ///< nothing in the ball is above (for min: below) this
  bool certain = false;    ///< |upper - F| is within the tolerance
  std::size_t bounds = 0;  ///< cells that were bounded
};
[[nodiscard]] BallTop search_ball(const BallSearch& search, const Vec3& x, Order order);

/// Where every search starts, as shifts in units of the radius: the middle, the axes, the diagonals. F is at
/// least the value of f at each, which ranges of F rely on.
inline constexpr std::size_t start_count = 15;
[[nodiscard]] Vec3 search_start(std::size_t k);

}  // namespace blendwright::detail
