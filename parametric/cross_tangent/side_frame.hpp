#pragma once
// One side of the blend along v: position, cross direction (1), and the primary's bend in that direction, as
// exact series. Private to this module.
#include <string>
#include <vector>

#include "kernel/geometry/enclosure.hpp"
#include "parametric/trimline/line_point.hpp"

namespace blendwright {

struct SideSeries {
  Series3 C;          ///< exact to order 3
  Series3 direction;  ///< cos psi k + sin psi C'/|C'|, unit; exact to order 2
  Series3 normal;     ///< n, unit
  Series bend;        ///< II(direction, direction), 1/model unit; exact to order 2
};

/// The same over a piece of v: jets in v as their first variable, exact to order 2 in C, 1 in direction and
/// normal, 0 in bend.
struct SideEnclosure {
  std::array<ModelJet, 3> C, direction, normal;
  TaylorModel bend;
  std::string unproven{};
};

class SideFrame {
 public:
  /// k = sign n x C'/|C'|. `harmless`: places where |C'| or |Su x Sv| vanishes but the limits from both sides
  /// agree.
  SideFrame(Trimline line, double sign, Radians psi, std::vector<double> harmless);

  [[nodiscard]] SideSeries first_order(double v) const;  ///< without the bend (and at half the cost)
  [[nodiscard]] SideSeries second_order(double v) const;
  [[nodiscard]] SideEnclosure enclosed(const TaylorModel& v) const;
  [[nodiscard]] Series3 position(double v) const { return to_series<3>(line_.jet(v)); }
  /// Value of `direction`, from the line's point at v.
  [[nodiscard]] Vec3 direction(double v, const LinePoint& point) const;
  [[nodiscard]] const Trimline& line() const { return line_; }

 private:
  [[nodiscard]] SideSeries regular(double v, bool with_bend) const;
  [[nodiscard]] SideSeries evaluated(double v, bool with_bend) const;
  [[nodiscard]] const double* harmless_near(double v) const;

  Trimline line_;
  double sign_, cos_psi_, sin_psi_;
  std::vector<double> harmless_;
};

}  // namespace blendwright
