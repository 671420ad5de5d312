#include "parametric/trimline/shifted.hpp"

#include <array>
#include <cmath>

#include "kernel/base/number_text.hpp"
#include "kernel/geometry/enclosure.hpp"
#include "parametric/trimline/law_spline.hpp"

namespace blendwright {
namespace {

std::vector<LawPoint> coordinate(const std::vector<ShiftPoint>& points, Eigen::Index axis) {
  std::vector<LawPoint> law;
  for (const ShiftPoint& p : points) law.push_back({p.t, p.by[axis]});
  return law;
}

/// du or dv as a function of the fraction t: line + periodic.
struct Coordinate {
  double start = 0.0, rise = 0.0, pace = 1.0;
  std::optional<ScalarSpline> periodic;  ///< of pace * t, period 1
  template <class T>
  [[nodiscard]] T operator()(const T& t) const {
    const T line = start + rise * t;
    return periodic ? line + (*periodic)(pace * t) : line;
  }
};

/// The natural spline over [0, 1]: what is left of a straight line through its ends, continued as an odd
/// function of period 2, has the unique periodic spline through its points, which is odd as well.
Coordinate natural(std::vector<LawPoint> law) {
  if (law.front().t > 0.0) law.insert(law.begin(), {0.0, law.front().value});
  if (law.back().t < 1.0) law.push_back({1.0, law.back().value});
  Coordinate c{law.front().value, law.back().value - law.front().value, 0.5, std::nullopt};
  std::vector<LawPoint> odd;
  for (const LawPoint& p : law) odd.push_back({0.5 * p.t, p.value - c.start - c.rise * p.t});
  odd.back().value = 0.0;
  for (std::size_t i = odd.size() - 1; i-- > 1;) odd.push_back({1.0 - odd[i].t, -odd[i].value});
  if (law.size() > 2) c.periodic = law_spline(odd, true);
  return c;
}

Coordinate coordinate_law(const std::vector<ShiftPoint>& points, Eigen::Index axis, bool closed) {
  std::vector<LawPoint> law = coordinate(points, axis);
  if (law.size() == 1) return {law[0].value, 0.0, 1.0, std::nullopt};
  if (!closed) return natural(std::move(law));
  return {0.0, 0.0, 1.0, law_spline(law, true)};
}

struct ShiftedCurve {
  Curve2 line;
  std::array<Coordinate, 2> by;
  CurveDomain range;

  [[nodiscard]] CurveJet<2> jet(double v) const {
    Series2 uv = to_series<2>(line.jet(v));
    const Series t = (Series::variable(v) - range.v.lo) / range.v.length();
    for (std::size_t d = 0; d < 2; ++d) uv[d] = uv[d] + by[d](t);
    return to_jet(uv);
  }
  void enclose(const TaylorModel& v, CurveEnclosure& out) const {
    if (!line.enclose(v, out)) {
      out.unproven = "the trimline's curve has no enclosure";
      return;
    }
    const ModelJet t = (ModelJet::u_variable(v) - range.v.lo) / ModelJet(range.v.length());
    CurveEnclosure more;
    fill(more, std::array<ModelJet, 2>{by[0](t), by[1](t)});
    for (std::size_t k = 0; k < out.D.size(); ++k)
      for (std::size_t d = 0; d < 2; ++d) out.D[k][d] = out.D[k][d] + more.D[k][d];
  }
  [[nodiscard]] CurveDomain domain() const { return range; }
};

}  // namespace

std::vector<Problem> check_shift(const std::vector<ShiftPoint>& points, bool closed,
                                 const std::string& where) {
  std::vector<Problem> problems;
  const std::vector<LawPoint> places = coordinate(points, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (Problem& problem : check_law_place(places, i, where)) problems.push_back(std::move(problem));
    if (!points[i].by.allFinite())
      problems.push_back({where + "/" + std::to_string(i), "must be a finite shift"});
  }
  if (closed && points.size() > 1 && points.front().t == 0.0 && points.back().t == 1.0 &&
      points.front().by != points.back().by)
    problems.push_back({where + "/" + std::to_string(points.size() - 1),
                        "differs from the shift at t = 0, which is the same point of a closed trimline; "
                        "leave one out"});
  return problems;
}

Trimline shifted(const Trimline& line, const std::vector<ShiftPoint>& points, double slack) {
  if (points.empty()) return line;
  const CurveDomain range = line.domain();
  std::vector<Problem> problems = check_shift(points, range.closed, "shift");
  if (!problems.empty()) throw InputError(std::move(problems));
  return Trimline(
      line.primary(),
      ShiftedCurve{line.pcurve(),
                   {coordinate_law(points, 0, range.closed), coordinate_law(points, 1, range.closed)},
                   range},
      slack);
}

}  // namespace blendwright
