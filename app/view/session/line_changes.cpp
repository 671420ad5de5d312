#include "app/view/session/line_changes.hpp"

#include <algorithm>
#include <cmath>

#include "app/view/session/blend_changes.hpp"
#include "kernel/geometry/project.hpp"

namespace blendwright {
namespace {

/// The first and last point of a closed line's shift may be the same place; one handle is enough.
std::vector<ShiftPoint> without_repeat(std::vector<ShiftPoint> shift, bool closed) {
  if (closed && shift.size() > 1 && shift.back().t == shift.front().t + 1.0) shift.pop_back();
  return shift;
}

/// The shift with a point at every handle.
std::vector<ShiftPoint> at_handles(const TrimlineSpec& spec, bool closed) {
  std::vector<ShiftPoint> shift = without_repeat(spec.shift, closed);
  if (shift.size() > 1) return shift;
  const Vec2 everywhere = shift.empty() ? Vec2(0.0, 0.0) : shift.front().by;
  shift.clear();
  for (std::size_t i = 0; i < handles_per_line; ++i) shift.push_back({handle_place(i, closed), everywhere});
  return shift;
}

/// Whether the line ends at v on the border of coordinate `axis` and comes in from there.
bool held_by_border(const Trimline& line, double v, Eigen::Index axis) {
  const SurfaceDomain box = line.primary().domain();
  if (axis == 0 ? box.u_closed : box.v_closed) return false;
  const Interval range = axis == 0 ? box.u : box.v, other = axis == 0 ? box.v : box.u;
  const CurveJet<2> at = line.pcurve().jet(v);
  const double x = at.C()[axis], slack = 1e-9 * range.length();
  const bool on_border = std::abs(x - range.lo) <= slack || std::abs(x - range.hi) <= slack;
  const double inwards = std::abs(at.C1()[axis]) / range.length();
  return on_border && inwards > 1e-6 * std::abs(at.C1()[1 - axis]) / other.length();
}

/// From the handle at v to the target, in the primary's parameters.
Vec2 step_to(const Trimline& line, double v, const Vec3& target) {
  const SurfaceDomain box = line.primary().domain();
  const Vec2 at = line.pcurve().point(v);
  const Foot foot = closest_point(line.primary(), target, UV{at[0], at[1]});
  Vec2 step(foot.at.u - at[0], foot.at.v - at[1]);
  const auto around = [](double x, const Interval& range) {
    return x - range.length() * std::round(x / range.length());
  };
  if (box.u_closed) step[0] = around(step[0], box.u);
  if (box.v_closed) step[1] = around(step[1], box.v);
  return step;
}

/// Cardinal B-spline of degree 5: 0 from |x| = 3 on, its integer translates add up to 1.
double bump(double x) {
  const auto power = [](double y) { return y > 0.0 ? std::pow(y, 5) : 0.0; };
  x = std::abs(x);
  return (power(3.0 - x) - 6.0 * power(2.0 - x) + 15.0 * power(1.0 - x)) / 120.0;
}

/// How far handle j follows handle `index`: 1 for itself. On equal steps the shift becomes a sum of B-splines
/// with coefficients of one sign, so that a line on the border of its primary is not led beyond it; the ends
/// of an open line stay unless they are moved themselves.
std::vector<double> followers(const std::vector<ShiftPoint>& shift, std::size_t index, bool closed) {
  const std::size_t n = shift.size();
  const double at = shift[index].t;
  const double before = index > 0 ? at - shift[index - 1].t : closed ? at + 1.0 - shift[n - 1].t : 1.0;
  const double after = index + 1 < n ? shift[index + 1].t - at : closed ? shift[0].t + 1.0 - at : 1.0;
  const double step = std::min({before, after, 1.0 / 6.0});
  const bool end = !closed && (index == 0 || index + 1 == n);
  std::vector<double> part;
  for (const ShiftPoint& p : shift) {
    const double x = std::abs(p.t - at) / step;
    if (closed)
      part.push_back(bump(std::min(x, 1.0 / step - x)));
    else if (end)  // the natural spline with the coefficients .., 2, 3/2, 1, 1/2, 0, ..
      part.push_back(2.0 * bump(x + 2.0) + 1.5 * bump(x + 1.0) + bump(x) + 0.5 * bump(x - 1.0));
    else  // odd about both ends
      part.push_back(bump(x) - bump((p.t + at) / step) - bump((2.0 - p.t - at) / step));
  }
  const double own = part[index];
  for (double& w : part) w /= own;
  if (end) part[index == 0 ? n - 1 : 0] = 0.0;
  return part;
}

}  // namespace

std::vector<double> line_handle_places(const TrimlineSpec& spec, bool closed) {
  std::vector<double> places;
  for (const ShiftPoint& p : at_handles(spec, closed)) places.push_back(p.t);
  return places;
}

TrimlineSpec moved_line(TrimlineSpec spec, const Trimline& line, std::size_t index,
                        SessionHandle::Reach reach, const Vec3& target) {
  const CurveDomain domain = line.domain();
  std::vector<ShiftPoint> shift = at_handles(spec, domain.closed);
  const bool whole = reach == SessionHandle::Reach::whole;
  Vec2 step = step_to(line, domain.v.at(shift.at(index).t), target);
  if (!domain.closed)
    for (const double t : {0.0, 1.0})
      for (Eigen::Index axis = 0; axis < 2; ++axis)
        if ((whole || shift[index].t == t) && held_by_border(line, domain.v.at(t), axis)) step[axis] = 0.0;
  if (!whole) {
    const std::vector<double> part = followers(shift, index, domain.closed);
    for (std::size_t i = 0; i < shift.size(); ++i) shift[i].by += part[i] * step;
    spec.shift = std::move(shift);
  } else if (spec.kind == TrimlineSpec::Kind::isoline) {
    spec.value += step[spec.direction == IsoDirection::constant_u ? 0 : 1];
  } else {
    if (spec.shift.empty()) spec.shift.push_back({});
    for (ShiftPoint& p : spec.shift) p.by += step;
  }
  return spec;
}

}  // namespace blendwright
