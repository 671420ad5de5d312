#pragma once
// What an operator of level function (solid f >= 0) makes of its arguments. Formulas are written for the
// intersection, which is like min; unions and differences are its duals:
//   union(f) = -intersection(-f), difference(f1, f2, ...) = intersection(f1, -f2, ...)
#include <cstddef>

namespace blendwright::detail {

enum class Join { unite, intersect, subtract };

/// The sign that argument i gets, and the result.
[[nodiscard]] constexpr double argument_sign(Join join, std::size_t i) {
  return join == Join::unite || (join == Join::subtract && i > 0) ? -1.0 : 1.0;
}
[[nodiscard]] constexpr double result_sign(Join join) { return join == Join::unite ? -1.0 : 1.0; }
/// The same for formulas written for the union: intersection(f) = -union(-f), difference(f1, f2) =
/// -union(-f1, f2).
[[nodiscard]] constexpr double outer_sign(Join join, std::size_t i) { return -argument_sign(join, i); }
/// Whether the result rises with argument i.
[[nodiscard]] constexpr bool rises(Join join, std::size_t i) { return join != Join::subtract || i == 0; }

/// Polynomial operators take fields beyond this for constants of this size, and give no larger ones: products
/// of a few of them, and their derivatives, stay numbers.
inline constexpr double saturation = 1e100;

}  // namespace blendwright::detail
