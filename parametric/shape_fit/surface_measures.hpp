#pragma once
// What the objectives measure at a point of the blend, with derivatives by the jet of the surface. Private to
// this module; automatic differentiation stays in the .cpp.
//
//   N = Su x Sv;  k_n = Suu.N / (|N| |Su|^2), the normal curvature of the u-line                          (1)
//   dk/ds = (d/du k_n) / |Su|, s the arc length of the u-line; its square is integrated over dA = |N| du dv
//   (2) k_1,2 = H +- sqrt(H^2 - K), principal curvatures (3)
#include "parametric/shape_fit/blend_model.hpp"

namespace blendwright::detail {

struct Measure {
  double value = 0.0;
  JetVector by = JetVector::Zero();
};
[[nodiscard]] Measure line_curvature(const JetVector& jet);                       ///< (1)
[[nodiscard]] Measure curvature_change(const JetVector& jet);                     ///< (2), times sqrt|N|
[[nodiscard]] std::array<Measure, 2> principal_curvatures(const JetVector& jet);  ///< (3), larger first
[[nodiscard]] Measure normal_along(const JetVector& jet, const Vec3& direction);  ///< N.direction / |N|

}  // namespace blendwright::detail
