#pragma once
// Maps of a new parameter to the parameter of a trimline: v_old = a + b x + p(x), x = c + d v_new. p is
// absent for linear maps, which then stay exact. Private to this module.
#include <optional>

#include "parametric/trimline/scalar_spline.hpp"
#include "parametric/trimline/trimline.hpp"

namespace blendwright {

/// x in [0, 1] (any x on a closed line) -> v_old: the inner part of the map.
struct FractionMap {
  double a = 0.0, b = 1.0;
  std::optional<ScalarSpline> p;  ///< periodic with period 1 on closed lines
  [[nodiscard]] Series operator()(const Series& x) const { return p ? a + b * x + (*p)(x) : a + b * x; }
  [[nodiscard]] ModelJet operator()(const ModelJet& x) const { return p ? a + b * x + (*p)(x) : a + b * x; }
};

/// Fraction of the parameter range.
[[nodiscard]] FractionMap parameter_fraction(const Trimline& line);

/// Fraction of the arc length, so that |dC/dx| is constant to 1e-6; exactly linear when the line's speed is
/// constant to 1e-12. Throws GeometryError where the speed vanishes (names v and the point).
[[nodiscard]] FractionMap arc_length_fraction(const Trimline& line);

/// A FractionMap seen from the new parameter, as a Curve<1>.
struct LineMap {
  FractionMap fraction;
  double c = 0.0, d = 1.0;
  CurveDomain range;
  [[nodiscard]] CurveJet<1> jet(double v) const {
    Series x(c + d * v);
    x.c[1] = d;
    return to_jet(std::array<Series, 1>{fraction(x)});
  }
  void enclose(const TaylorModel& v, CurveEnclosure& out) const {
    fill(out, std::array<ModelJet, 1>{fraction(c + d * ModelJet::u_variable(v))});
  }
  [[nodiscard]] CurveDomain domain() const { return range; }
};

}  // namespace blendwright
