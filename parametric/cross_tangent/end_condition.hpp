#pragma once
// What the blend must meet at one end: position C(v), cross tangent T(v) = Su, and second derivative D(v) =
// Suu.
#include <functional>

#include "kernel/geometry/series.hpp"

namespace blendwright {

/// Values with derivatives along v: C to order 3, T and D to order 2 (higher coefficients are not
/// meaningful).
struct EndSeries {
  Series3 C, T, D;
};

struct EndCondition {
  CurveDomain domain;
  Continuity continuity = Continuity::G1;  ///< what these data achieve on the primary; D is used from G2 on
  std::function<EndSeries(double v)> series;
};

}  // namespace blendwright
