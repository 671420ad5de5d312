#include "parametric/trimline/law_spline.hpp"

#include <utility>

#include "kernel/base/number_text.hpp"

namespace blendwright {

std::optional<ScalarSpline> law_spline(const std::vector<LawPoint>& points, bool closed) {
  std::vector<double> t, value;
  for (const LawPoint& p : points) {
    t.push_back(p.t);
    value.push_back(p.value);
  }
  if (closed && t.size() > 1 && t.back() == t.front() + 1.0) {  // repeats the first point
    t.pop_back();
    value.pop_back();
  }
  if (t.size() < 2) return std::nullopt;
  if (!closed) {
    if (t.front() > 0.0) t.insert(t.begin(), 0.0), value.insert(value.begin(), value.front());
    if (t.back() < 1.0) t.push_back(1.0), value.push_back(value.back());
    return ScalarSpline::open(std::move(t), value);
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
  return ScalarSpline::closed(std::move(breaks), repeated);
}

std::vector<Problem> check_law_place(const std::vector<LawPoint>& points, std::size_t i,
                                     const std::string& where) {
  std::vector<Problem> problems;
  const double t = points[i].t;
  const std::string at = where + "/" + std::to_string(i);
  if (!(t >= 0.0 && t <= 1.0))
    problems.push_back({at, "is at t = " + number_text(t) + ", must lie in [0, 1] (fraction of the range)"});
  if (i > 0 && !(t > points[i - 1].t))
    problems.push_back(
        {at, "is at t = " + number_text(t) + ", must come after " + number_text(points[i - 1].t)});
  return problems;
}

}  // namespace blendwright
