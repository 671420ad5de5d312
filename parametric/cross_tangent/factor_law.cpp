#include "parametric/cross_tangent/factor_law.hpp"

#include <cmath>

#include "kernel/base/number_text.hpp"

namespace blendwright {

FactorLaw::FactorLaw(const std::vector<LawPoint>& points, CurveDomain domain)
    : domain_(domain), constant_(points.front().value) {
  std::vector<double> t, value;
  for (const LawPoint& p : points) {
    t.push_back(p.t);
    value.push_back(p.value);
  }
  if (domain.closed && t.size() > 1 && t.back() == t.front() + 1.0) {  // repeats the first point
    t.pop_back();
    value.pop_back();
  }
  if (t.size() < 2) return;
  if (!domain.closed) {
    if (t.front() > 0.0) t.insert(t.begin(), 0.0), value.insert(value.begin(), value.front());
    if (t.back() < 1.0) t.push_back(1.0), value.push_back(value.back());
    spline_ = ScalarSpline::open(std::move(t), value);
    return;
  }
  // The spline over several periods of repeated data is unique, hence has the short period itself.
  const std::size_t count = t.size(), periods = (ScalarSpline::degree + count) / count;
  std::vector<double> breaks, repeated;
  for (std::size_t k = 0; k < periods; ++k)
    for (std::size_t i = 0; i < count; ++i) {
      breaks.push_back(t[i] + static_cast<double>(k));
      repeated.push_back(value[i]);
    }
  breaks.push_back(t[0] + static_cast<double>(periods));
  spline_ = ScalarSpline::closed(std::move(breaks), repeated);
}

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
    const std::string at = where + "/" + std::to_string(i);
    if (!(p.t >= 0.0 && p.t <= 1.0))
      problems.push_back(
          {at, "is at t = " + number_text(p.t) + ", must lie in [0, 1] (fraction of the range)"});
    if (!(p.value > 0.0) || !std::isfinite(p.value))
      problems.push_back({at, "is " + number_text(p.value) + ", must be > 0"});
    if (i > 0 && !(p.t > points[i - 1].t))
      problems.push_back(
          {at, "is at t = " + number_text(p.t) + ", must come after " + number_text(points[i - 1].t)});
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
