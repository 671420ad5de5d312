#include "parametric/trimline/trimline.hpp"

#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/geometry/enclosure.hpp"
#include "kernel/math/quadrature.hpp"
#include "parametric/trimline/line_point.hpp"

namespace blendwright {
namespace {

constexpr int check_samples = 256;

/// How far x lies beyond the interval, relative to its length; NaN stays NaN.
double excess(const Interval& i, double x) { return std::max(i.lo - x, x - i.hi) / i.length(); }

/// How far in space a step `over` beyond the domain leads.
double reach_beyond(const Surface& primary, const Vec2& p, int axis, double over) {
  const SurfaceDomain box = primary.domain();
  const SurfaceJet s =
      primary.jet({box.u_closed ? p[0] : box.u.clamp(p[0]), box.v_closed ? p[1] : box.v.clamp(p[1])});
  return over * (axis == 0 ? s.Su : s.Sv).norm();
}

void check_inside(const Surface& primary, const CurveDomain& domain, const Curve2& pcurve, double slack) {
  const SurfaceDomain box = primary.domain();
  for (int i = 0; i <= check_samples; ++i) {
    const double v = domain.v.at(static_cast<double>(i) / check_samples);
    const Vec2 p = pcurve.point(v);
    for (int axis = 0; axis < 2; ++axis) {
      const Interval& range = axis == 0 ? box.u : box.v;
      const bool closed = axis == 0 ? box.u_closed : box.v_closed;
      if (closed ? std::isfinite(p[axis]) : excess(range, p[axis]) <= 1e-9) continue;
      const double over = std::max(range.lo - p[axis], p[axis] - range.hi);
      if (slack > 0.0 && reach_beyond(primary, p, axis, over) <= slack) continue;
      const std::string name = axis == 0 ? "u" : "v";
      throw GeometryError("the trimline leaves its primary " + place(v, primary.point({p[0], p[1]})) +
                          ": the primary's " + name + " = " + number_text(p[axis], 6) + " is " +
                          scientific_text(over) + " beyond [" + number_text(range.lo, 6) + ", " +
                          number_text(range.hi, 6) + "]; shorten the trimline or extend the primary");
    }
  }
}

void check_closes(const Surface& primary, const CurveDomain& domain, const Curve2& pcurve) {
  const auto point = [&](double v) {
    const Vec2 p = pcurve.point(v);
    return primary.point({p[0], p[1]});
  };
  const Vec3 first = point(domain.v.lo);
  double size = 0.0;
  for (int i = 1; i < 8; ++i) size = std::max(size, (point(domain.v.at(i / 8.0)) - first).norm());
  const double gap = (point(domain.v.hi) - first).norm();
  if (gap > 1e-6 * size)
    throw GeometryError("the trimline is called closed but its ends are " + scientific_text(gap) +
                        " apart, " + place(domain.v.lo, first) +
                        "; it must close to 1e-6 of its size, or be open");
}

/// A straight pcurve along one parameter direction.
struct IsoCurve {
  IsoDirection direction;
  double value;
  CurveDomain range;
  [[nodiscard]] CurveJet<2> jet(double v) const {
    const Vec2 zero = Vec2::Zero();
    if (direction == IsoDirection::constant_u) return {{Vec2(value, v), Vec2(0.0, 1.0), zero, zero}};
    return {{Vec2(v, value), Vec2(1.0, 0.0), zero, zero}};
  }
  void enclose(const TaylorModel& v, CurveEnclosure& out) const {
    const std::size_t running = direction == IsoDirection::constant_u ? 1 : 0;
    out.D[0][running] = v;
    out.D[0][1 - running] = value;
    out.D[1][running] = 1.0;
  }
  [[nodiscard]] CurveDomain domain() const { return range; }
};

/// pcurve(map(v)); beyond a closed old domain the pcurve goes on unrolled, `turn` further on per period.
struct ReparametrisedCurve {
  Curve2 pcurve;
  Curve<1> map;
  CurveDomain range;
  Vec2 turn;
  [[nodiscard]] CurveJet<2> jet(double v) const {
    const CurveJet<1> m = map.jet(v);
    const Wrapped w = wrapped(pcurve.domain(), m.C()[0]);
    const CurveJet<2> p = pcurve.jet(w.inside);
    const double a = m.C1()[0], b = m.C2()[0], c = m.C3()[0];
    // Chain rule to order 3 (Faa di Bruno).
    return {{p.C() + w.turns * turn, a * p.C1(), b * p.C1() + a * a * p.C2(),
             c * p.C1() + 3.0 * a * b * p.C2() + a * a * a * p.C3()}};
  }
  void enclose(const TaylorModel& v, CurveEnclosure& out) const {
    const CurveDomain old = pcurve.domain();
    CurveEnclosure m, p;
    if (!map.enclose(v, m)) m.unproven = "the parameter's map has no enclosure";
    double turns = 0.0;
    const TaylorModel inside = inside_range(m.D[0][0], old.v.lo, old.v.hi, old.closed, &turns);
    if (!pcurve.enclose(inside, p)) p.unproven = "the trimline's curve has no enclosure";
    out.unproven = m.unproven.empty() ? p.unproven : m.unproven;
    const TaylorModel &a = m.D[1][0], &b = m.D[2][0];
    for (std::size_t d = 0; d < 2; ++d) {
      out.D[0][d] = p.D[0][d] + TaylorModel(Bounds(turns) * Bounds(turn[static_cast<Eigen::Index>(d)]));
      out.D[1][d] = a * p.D[1][d];
      out.D[2][d] = b * p.D[1][d] + (a * a) * p.D[2][d];
    }
  }
  [[nodiscard]] CurveDomain domain() const { return range; }
};

/// The whole number of the primary's periods that the pcurve advances over its own period.
Vec2 turn_of(const Surface& primary, const Curve2& pcurve) {
  const SurfaceDomain box = primary.domain();
  const Interval v = pcurve.domain().v;
  const Vec2 step = pcurve.point(v.hi) - pcurve.point(v.lo);
  const auto whole = [](const Interval& range, bool closed, double x) {
    return closed ? std::round(x / range.length()) * range.length() : 0.0;
  };
  return {whole(box.u, box.u_closed, step[0]), whole(box.v, box.v_closed, step[1])};
}

}  // namespace

Trimline::Trimline(Surface primary, Curve2 pcurve, Checked)
    : primary_(std::move(primary)), pcurve_(std::move(pcurve)), domain_(pcurve_.domain()) {}

Trimline::Trimline(Surface primary, Curve2 pcurve, double slack)
    : Trimline(std::move(primary), std::move(pcurve), Checked{}) {
  if (!(domain_.v.lo < domain_.v.hi) || !std::isfinite(domain_.v.length()))
    throw GeometryError("the trimline's range [" + number_text(domain_.v.lo) + ", " +
                        number_text(domain_.v.hi) + "] is empty; its start must be below its end");
  check_inside(primary_, domain_, pcurve_, slack);
  if (domain_.closed) check_closes(primary_, domain_, pcurve_);
}

CurveJet<3> Trimline::jet(double v) const {
  const Series2 uv = to_series<2>(pcurve_.jet(wrapped(domain_, v).inside));
  return to_jet(along(primary_.partials({uv[0].value(), uv[1].value()}), 0, 0, uv));
}

double Trimline::length() const {
  // 64 panels of 8 nodes: relative error below 1e-12 for lines whose speed varies on the scale of 1/10 of the
  // range.
  constexpr int panels = 64;
  const QuadratureRule& rule = gauss_legendre(8);
  double sum = 0.0;
  for (int k = 0; k < panels; ++k)
    for (std::size_t i = 0; i < rule.x.size(); ++i)
      sum += rule.w[i] * line_point(*this, domain_.v.at((k + rule.x[i]) / panels)).C1.norm();
  return sum * domain_.v.length() / panels;
}

Trimline isoline(const Surface& primary, IsoDirection direction, double value,
                 std::optional<Interval> range) {
  const SurfaceDomain box = primary.domain();
  const bool along_v = direction == IsoDirection::constant_u;
  const Interval whole = along_v ? box.v : box.u;
  const bool closes = along_v ? box.v_closed : box.u_closed;
  const Interval v = range.value_or(whole);
  const double period = whole.length();
  if (closes && v.length() > period * (1.0 + 1e-12))
    throw GeometryError("the isoline's range [" + number_text(v.lo) + ", " + number_text(v.hi) +
                        "] is longer than one turn of the primary, " + number_text(period));
  const bool closed = closes && v.length() >= period * (1.0 - 1e-12);
  return Trimline(primary, IsoCurve{direction, value, {v, closed}});
}

Trimline reparametrised(const Trimline& line, const Curve<1>& map) {
  const CurveDomain old = line.domain(), range = map.domain();
  constexpr int samples = 64;
  const double sign = map.jet(range.v.middle()).C1()[0] > 0.0 ? 1.0 : -1.0;
  for (int i = 0; i <= samples; ++i) {
    const double v = range.v.at(static_cast<double>(i) / samples);
    const CurveJet<1> m = map.jet(v);
    if (!(sign * m.C1()[0] > 0.0))
      throw GeometryError("the new parameter is not monotone at v = " + number_text(v, 6) +
                          ": its slope is " + number_text(m.C1()[0], 6) + ", must keep one sign");
    if (!old.closed && !(excess(old.v, m.C()[0]) <= 1e-9))
      throw GeometryError("the new parameter leaves the line at v = " + number_text(v, 6) + ": " +
                          number_text(m.C()[0], 6) + " lies outside [" + number_text(old.v.lo, 6) + ", " +
                          number_text(old.v.hi, 6) + "]");
  }
  const Vec2 turn = old.closed ? turn_of(line.primary(), line.pcurve()) : Vec2(0.0, 0.0);
  const double advance = std::abs(map.point(range.v.hi)[0] - map.point(range.v.lo)[0]);
  const bool once_round = std::abs(advance - old.v.length()) <= 1e-9 * old.v.length();
  const CurveDomain closed_as{range.v, old.closed && range.closed && once_round};
  return Trimline(line.primary(), ReparametrisedCurve{line.pcurve(), map, closed_as, turn},
                  Trimline::Checked{});
}

}  // namespace blendwright
