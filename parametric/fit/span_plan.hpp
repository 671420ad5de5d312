#pragma once
// Where the breaks of a fit go and where its error is looked at.
#include <array>
#include <vector>

namespace blendwright::detail {

/// The inner Chebyshev-Lobatto points of a span [0, 1] with 6 intervals. The error of an interpolating
/// quintic spline is on every span, to leading order, a polynomial of degree 6 that vanishes at both ends.
/// Such a polynomial is at most `sample_factor` times its largest value at these points (their Lebesgue
/// constant, 1.9102).
inline constexpr std::array<double, 5> span_samples{0.066987298107780677, 0.25, 0.5, 0.75,
                                                    0.93301270189221932};
inline constexpr double sample_factor = 1.9103;

/// Breaks on [0, 1] with density (q + 1)(exp(-q u/6) + exp(-q (1 - u)/6)) + 1/2, symmetric about 1/2;
/// neighbouring spans within a factor 4. q >= 0: width of the boundary layers is 1/q.
[[nodiscard]] std::vector<double> graded_breaks(double q, int spans);

/// New breaks after a fit whose span i should have been split into wanted[i] spans (a real number; below 1
/// where it was finer than needed). Even needs keep the pattern of the breaks; uneven ones move breaks to
/// where they are needed. Always more spans than before; neighbouring spans within a factor 4, across the
/// seam too when periodic.
[[nodiscard]] std::vector<double> refined_breaks(const std::vector<double>& breaks,
                                                 std::vector<double> wanted, bool periodic);

}  // namespace blendwright::detail
