#include "parametric/cross_tangent/factor_law.hpp"

#include <cmath>
#include <utility>

#include "kernel/base/number_text.hpp"
#include "parametric/trimline/law_spline.hpp"

namespace blendwright {

FactorLaw::FactorLaw(const std::vector<LawPoint>& points, CurveDomain domain)
    : domain_(domain), constant_(points.front().value), spline_(law_spline(points, domain.closed)) {}

double FactorLaw::operator()(double v) const {
  return spline_ ? (*spline_)((v - domain_.v.lo) / domain_.v.length()) : constant_;
}

Series FactorLaw::operator()(const Series& v) const {
  return spline_ ? (*spline_)((v - domain_.v.lo) / domain_.v.length()) : Series(constant_);
}

ModelJet FactorLaw::operator()(const ModelJet& v) const {
  return spline_ ? (*spline_)((v - domain_.v.lo) / domain_.v.length()) : ModelJet(constant_);
}

std::vector<Problem> check_law(const std::vector<LawPoint>& points, bool closed, const std::string& where) {
  std::vector<Problem> problems;
  if (points.empty()) problems.push_back({where, "is empty, must have at least one value"});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LawPoint& p = points[i];
    for (Problem& problem : check_law_place(points, i, where)) problems.push_back(std::move(problem));
    if (!(p.value > 0.0) || !std::isfinite(p.value))
      problems.push_back({where + "/" + std::to_string(i), "is " + number_text(p.value) + ", must be > 0"});
  }
  if (closed && points.size() > 1 && points.front().t == 0.0 && points.back().t == 1.0 &&
      points.front().value != points.back().value)
    problems.push_back(
        {where, "is " + number_text(points.front().value) + " at t = 0 and " +
                    number_text(points.back().value) +
                    " at t = 1, which are the same point of a closed trimline; leave one out"});
  if (!problems.empty()) return problems;
  constexpr int samples = 512;
  const FactorLaw law(points, {{0.0, 1.0}, closed});
  for (int i = 0; i <= samples; ++i) {
    const double t = static_cast<double>(i) / samples;
    if (law(t) > 0.0) continue;
    return {{where, "falls to " + number_text(law(t), 4) + " between its points, at t = " +
                        number_text(t, 4) + ", must stay > 0; add points there"}};
  }
  return problems;
}

}  // namespace blendwright
