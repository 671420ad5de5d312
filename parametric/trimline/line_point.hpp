#pragma once
// A trimline's point to second order and the primary's normal there: what sampling needs, at half the cost of
// the exact third-order jet. Private to this module.
#include <Eigen/Geometry>
#include <cstddef>
#include <string>

#include "parametric/trimline/trimline.hpp"

namespace blendwright {

struct LinePoint {
  Vec3 C, C1, C2;  ///< position and derivatives along v
  Vec3 n;          ///< Su x Sv of the primary, not normalised
  double scale;    ///< |Su| + |Sv|
  double reach;    ///< scale |(u', v')|: what |C'| is measured against
};
[[nodiscard]] LinePoint line_point(const Trimline& line, double v);

/// v = inside + turns * (length of the domain); turns is 0 on open lines and within the domain.
struct Wrapped {
  double inside = 0.0, turns = 0.0;
};
[[nodiscard]] Wrapped wrapped(const CurveDomain& domain, double v);

/// What a job calls the sides.
[[nodiscard]] inline const char* side_name(std::size_t side) { return side == 0 ? "from" : "to"; }

/// "(1, 0, 2)"
[[nodiscard]] std::string point_text(const Vec3& point);
/// "at v = 0.25 (1, 0, 2)"
[[nodiscard]] std::string place(double v, const Vec3& point);

}  // namespace blendwright
