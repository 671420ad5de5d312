#pragma once
// What the blend must meet at one end: position C(v), cross tangent T(v) = Su, and second derivative D(v) =
// Suu.
#include <functional>
#include <string>

#include "kernel/geometry/enclosure.hpp"
#include "kernel/geometry/series.hpp"

namespace blendwright {

/// Values with derivatives along v: C to order 3, T and D to order 2 (higher coefficients are not
/// meaningful).
struct EndSeries {
  Series3 C, T, D;
};

/// The same over a piece of v, enclosed: C to order 2, T to order 1, D to order 0.
struct EndEnclosure {
  std::array<ModelVector, 3> C{};
  std::array<ModelVector, 2> T{};
  ModelVector D{};
  std::string unproven{};  ///< why there is no enclosure
};

struct EndCondition {
  CurveDomain domain;
  Continuity continuity = Continuity::G1;  ///< what these data achieve on the primary; D is used from G2 on
  std::function<EndSeries(double v)> series;
  /// Empty: how the data run between points is not known.
  std::function<EndEnclosure(const TaylorModel& v)> enclosure{};
};

}  // namespace blendwright
