#pragma once
// Enclosures of B-splines: the exact polynomial pieces, in Taylor models.
//
// On a knot span the functions N_i are polynomials; the recursion of Cox and de Boor is evaluated on the
// model of the parameter itself, so that nothing is sampled. A model whose range reaches over knots gets the
// pieces on both sides, and the result contains both: a spline that is smooth there makes them differ by
// O(length^(continuity + 1)), so that smaller pieces converge. Source: Piegl and Tiller, The NURBS Book,
// A2.2.
#include <array>
#include <vector>

#include "kernel/geometry/bspline.hpp"
#include "kernel/geometry/enclosure.hpp"

namespace blendwright {

/// The functions that do not vanish on one span: value[k][i] is the k-th derivative of function first + i.
struct SplinePiece {
  int first = 0;
  std::array<std::vector<TaylorModel>, 3> value{};
};

/// The pieces over the range of t; empty when t leaves an open domain by more than 1e-9 of its length or
/// reaches over more than four spans. What reaches over the seam of a periodic basis by less than 1e-14 of
/// the period, a rounding of the end of a piece, belongs to the continuation of the piece.
[[nodiscard]] std::vector<SplinePiece> spline_pieces(const BSplineBasis& basis, const TaylorModel& t);

}  // namespace blendwright
