#pragma once
// Derivatives from positions alone.
//
//   central:    D(h) = (f(x + h) - f(x - h)) / 2h,  error c1 h^2 + c2 h^4 + ...                           (1)
//   one-sided:  D(h) = (f(x + h) - f(x)) / h,       error c1 h   + c2 h^2 + ...                           (2)
// h is halved from row to row, and each column of the tableau removes one more power of h (Richardson). Taken
// is the entry whose error estimate is smallest,
//   error = max(|T(k,j) - T(k,j-1)|, |T(k,j) - T(k-1,j-1)|) + 2 eps max|f| / h_k * growth(j)              (3)
// where the second term is what rounding of f makes of the entry, grown by the extrapolation's weights.
// Source: C. Ridders, Accurate computation of F'(x) and F'(x) F''(x), Advances in Engineering Software, 1982.
#include <functional>

#include "kernel/base/units.hpp"

namespace blendwright::detail {

struct Derivative {
  Vec3 value;
  double error = 0.0;  ///< estimate (3)
};

/// f'(x); f is asked within `range` only. Central where x has room on both sides, else to the side with more.
/// At most 28 rows: steps down to 1e-9 of the first, which is an eighth of the room.
[[nodiscard]] Derivative difference_quotient(const std::function<Vec3(double)>& f, double x,
                                             const Interval& range);

}  // namespace blendwright::detail
