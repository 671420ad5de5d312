#pragma once
// A factor that varies along v. Private to this module.
#include <optional>
#include <vector>

#include "kernel/base/error.hpp"
#include "parametric/cross_tangent/cross_tangent.hpp"
#include "parametric/trimline/scalar_spline.hpp"

namespace blendwright {

/// Quintic spline (C4) through the law's points over the fraction t of the range; periodic on closed lines,
/// where few points are repeated over several periods so that the spline exists. Open lines: the first and
/// last value hold at the ends of the range when no point is given there.
class FactorLaw {
 public:
  /// The points must have passed check_law.
  FactorLaw(const std::vector<LawPoint>& points, CurveDomain domain);
  [[nodiscard]] double operator()(double v) const;
  [[nodiscard]] Series operator()(const Series& v) const;
  [[nodiscard]] ModelJet operator()(const ModelJet& v) const;

 private:
  CurveDomain domain_;
  double constant_ = 1.0;
  std::optional<ScalarSpline> spline_;
};

/// Everything wrong with a law, under the name `where`.
[[nodiscard]] std::vector<Problem> check_law(const std::vector<LawPoint>& points, bool closed,
                                             const std::string& where);

}  // namespace blendwright
