#pragma once
// Private: where a curve in a spline's parameters meets a knot at which the spline's parametrisation is not
// smooth.
#include <Geom_Surface.hxx>
#include <functional>
#include <vector>

#include "kernel/base/units.hpp"

namespace blendwright::detail {

/// Parameters strictly inside `range`, ascending, at which `curve` crosses a knot where the surface has less
/// than three continuous derivatives. A circle as a rational B-spline is smooth in space, but its parameter
/// changes speed there, so the parameter curve of a smooth line has a corner. Empty for surfaces without
/// knots.
[[nodiscard]] std::vector<double> surface_kinks(const opencascade::handle<Geom_Surface>& surface,
                                                const std::function<Vec2(double)>& curve,
                                                const Interval& range);

/// Whether such a knot passes through the point.
[[nodiscard]] bool on_surface_kink(const opencascade::handle<Geom_Surface>& surface, const Vec2& uv);

}  // namespace blendwright::detail
