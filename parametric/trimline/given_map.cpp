#include "parametric/trimline/given_map.hpp"

#include <cmath>
#include <utility>

#include "kernel/base/number_text.hpp"
#include "parametric/trimline/law_spline.hpp"

namespace blendwright {
namespace {

std::string at(std::size_t i) { return "map/" + std::to_string(i); }

/// The end points of an open map, which are implied.
bool is_end(const LawPoint& p) { return (p.t == 0.0 || p.t == 1.0) && p.value == p.t; }

/// A point after another, or after the last one's image a period before it.
std::vector<Problem> check_order(const std::vector<LawPoint>& points, bool closed) {
  std::vector<Problem> problems;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (!(points[i].value > points[i - 1].value))
      problems.push_back({at(i), "joins the fraction " + number_text(points[i].value) +
                                     ", must be above that of the point before, " +
                                     number_text(points[i - 1].value)});
  if (closed && points.size() > 1 && !(points.back().value < points.front().value + 1.0))
    problems.push_back({at(points.size() - 1), "joins the fraction " + number_text(points.back().value) +
                                                   ", must be below that of the first point a turn on, " +
                                                   number_text(points.front().value + 1.0)});
  return problems;
}

}  // namespace

FractionMap given_map(const std::vector<LawPoint>& points, bool closed) {
  std::vector<LawPoint> beyond;
  for (const LawPoint& p : points) beyond.push_back({p.t, p.value - p.t});
  if (!closed) {
    if (beyond.front().t > 0.0) beyond.insert(beyond.begin(), {0.0, 0.0});
    if (beyond.back().t < 1.0) beyond.push_back({1.0, 0.0});
  }
  FractionMap g{0.0, 1.0, law_spline(beyond, closed)};
  if (!g.p) g.a = beyond.front().value;
  return g;
}

std::vector<Problem> check_map(const std::vector<LawPoint>& points, bool closed) {
  std::vector<Problem> problems;
  if (points.empty()) return {{"map", "is empty, must have at least one point [t, fraction] for this rule"}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LawPoint& p = points[i];
    for (Problem& problem : check_law_place(points, i, "map")) problems.push_back(std::move(problem));
    if (!std::isfinite(p.value)) {
      problems.push_back({at(i), "joins no finite fraction"});
    } else if (closed && p.t == 1.0) {
      problems.push_back({at(i), "is at t = 1, the same place as t = 0 on closed trimlines; leave it out"});
    } else if (!closed && !is_end(p) && !(p.t > 0.0 && p.t < 1.0 && p.value > 0.0 && p.value < 1.0)) {
      problems.push_back({at(i), "joins " + number_text(p.t) + " to " + number_text(p.value) +
                                     "; on open trimlines the ends belong together, between them both "
                                     "must lie in (0, 1)"});
    }
  }
  if (problems.empty()) problems = check_order(points, closed);
  if (!problems.empty()) return problems;
  constexpr int samples = 1024;
  const FractionMap g = given_map(points, closed);
  for (int i = 0; i <= samples; ++i) {
    const double t = static_cast<double>(i) / samples, slope = g(Series::variable(t)).derivative(1);
    if (slope > 1e-6) continue;
    return {{"map", "runs back between its points, at t = " + number_text(t, 4) + " (slope " +
                        number_text(slope, 3) +
                        "); it must increase: add points there or move them closer"
                        " to a straight line"}};
  }
  return {};
}

}  // namespace blendwright
