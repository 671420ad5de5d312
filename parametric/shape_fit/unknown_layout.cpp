#include "parametric/shape_fit/unknown_layout.hpp"

#include "parametric/trimline/law_spline.hpp"

namespace blendwright::detail {

LinearLaw::LinearLaw(const std::vector<LawPoint>& fixed, bool closed)
    : constant_(fixed.front().value), fixed_(law_spline(fixed, closed)) {}

LinearLaw LinearLaw::unknown(const std::vector<double>& t, bool closed, bool pinned) {
  LinearLaw law;
  law.t_ = t;
  for (std::size_t j = 0; j < t.size(); ++j) {
    std::vector<LawPoint> unit;
    if (pinned) unit.push_back({0.0, 0.0});
    for (std::size_t i = 0; i < t.size(); ++i) unit.push_back({t[i], i == j ? 1.0 : 0.0});
    if (pinned) unit.push_back({1.0, 0.0});
    law.rows_.push_back(law_spline(unit, closed));
  }
  return law;
}

Series LinearLaw::row(std::size_t j, double t) const {
  return rows_[j] ? (*rows_[j])(Series::variable(t)) : Series(1.0);
}

Series LinearLaw::operator()(double t, const double* values) const {
  if (t_.empty()) return fixed_ ? (*fixed_)(Series::variable(t)) : Series(constant_);
  Series f(0.0);
  for (std::size_t j = 0; j < t_.size(); ++j) f = f + values[j] * row(j, t);
  return f;
}

std::size_t Layout::law_start(std::size_t side) const {
  return static_cast<std::size_t>(count(shape)) + (side == 1 ? law[0].unknowns() : 0);
}
std::size_t Layout::angle_start(std::size_t side) const {
  return law_start(1) + law[1].unknowns() + (side == 1 && angle[0] ? 1 : 0);
}
std::size_t Layout::map_start() const { return angle_start(1) + (angle[1] ? 1 : 0); }
std::size_t Layout::size() const { return map_start() + (mapped ? map.unknowns() : 0); }

}  // namespace blendwright::detail
