#pragma once
// Private: curves in a surface's parameters that a periodic spline alone cannot express.
#include <utility>
#include <vector>

#include "kernel/geometry/bspline.hpp"
#include "kernel/geometry/curve.hpp"
#include "kernel/geometry/enclosure.hpp"

namespace blendwright::detail {

/// start + rate (v - lo): isolines of elementary surfaces, exactly.
struct ParameterLine {
  Vec2 start = Vec2::Zero(), rate = Vec2::Zero();
  CurveDomain box;
  [[nodiscard]] CurveJet<2> jet(double v) const {
    return {{start + rate * (v - box.v.lo), rate, Vec2::Zero(), Vec2::Zero()}};
  }
  void enclose(const TaylorModel& v, CurveEnclosure& out) const {
    for (std::size_t d = 0; d < 2; ++d) {
      const auto i = static_cast<Eigen::Index>(d);
      out.D[0][d] = TaylorModel(start[i]) + rate[i] * (v - TaylorModel(box.v.lo));
      out.D[1][d] = rate[i];
    }
  }
  [[nodiscard]] CurveDomain domain() const { return box; }
};

/// spline(v) + rate (v - lo): a curve that winds around a closed direction of its surface while v runs once
/// through the period of the spline.
struct WindingSpline {
  BSplineCurve<2> spline;
  Vec2 rate = Vec2::Zero();
  [[nodiscard]] CurveJet<2> jet(double v) const {
    CurveJet<2> j = spline.jet(v);
    j.D[0] += rate * (v - domain().v.lo);
    j.D[1] += rate;
    return j;
  }
  void enclose(const TaylorModel& v, CurveEnclosure& out) const {
    spline.enclose(v, out);
    for (std::size_t d = 0; d < 2; ++d) {
      const double slope = rate[static_cast<Eigen::Index>(d)];
      out.D[0][d] = out.D[0][d] + slope * (v - TaylorModel(domain().v.lo));
      out.D[1][d] = out.D[1][d] + TaylorModel(slope);
    }
  }
  [[nodiscard]] CurveDomain domain() const { return spline.domain(); }
};

/// Clamped pieces one after the other as one spline, with C0 knots between them; of dimension 2 or 3.
template <int Dim>
[[nodiscard]] BSplineCurve<Dim> joined(const std::vector<BSplineCurve<Dim>>& pieces, bool closed);

}  // namespace blendwright::detail
