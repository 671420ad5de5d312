#pragma once
// The monotone map of trimline 1 that turns the connecting lines least. Private to this module; the optimiser
// stays in the .cpp.
#include "parametric/trimline/line_map.hpp"

namespace blendwright {

/// Minimises over g the cost int |d(De/|De|)/dx|^2 + 1e-4 g''^2 dx, De = C1(g(x)) - C0(x), x in [0, 1] (1)
/// g(x) = o + int_0^x softplus(a) / int_0^1 softplus(a), a: cubic spline with 12 spans, periodic on closed
/// lines    (2) Both lines run over [0, 1] and are arranged already (direction and seam). `free_offset`: o is
/// found too (closed lines), else o = 0. Starts at g(x) = x and returns it exactly when no improvement above
/// 1e-12 is found.
[[nodiscard]] FractionMap least_twist_map(const Trimline& line0, const Trimline& line1, bool free_offset);

/// The first term of (1), on 256 samples.
[[nodiscard]] double twist_cost(const Trimline& line0, const Trimline& line1);

}  // namespace blendwright
