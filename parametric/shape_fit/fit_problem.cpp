#include "parametric/shape_fit/fit_problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "parametric/cross_tangent/factor_law.hpp"
#include "parametric/trimline/line_point.hpp"

namespace blendwright::detail {
namespace {

/// Where n values of a law stand: the start's own places when there are as many.
std::vector<double> law_places(const std::vector<LawPoint>& start, int n, bool closed) {
  std::vector<double> t;
  if (static_cast<int>(start.size()) == n) {
    for (const LawPoint& p : start) t.push_back(p.t);
    if (!(closed && n > 1 && t.back() == t.front() + 1.0)) return t;
    t.clear();
  }
  for (int j = 0; j < n; ++j) {
    const double last = closed || n == 1 ? n : n - 1;
    t.push_back(j / last);
  }
  return t;
}

/// The fraction of the (arranged) line whose point is nearest to p.
double fraction_of(const Trimline& line, const Vec3& p, double guess) {
  const bool closed = line.domain().closed;
  const Interval range = line.domain().v;
  double best = guess, least = HUGE_VAL;
  for (int i = -32; i <= 32; ++i) {
    double t = guess + i / 64.0;
    if (!closed) t = std::clamp(t, 0.0, 1.0);
    const double away = (line_point(line, range.at(t)).C - p).norm();
    if (away < least) least = away, best = t;
  }
  for (int i = 0; i < 20; ++i) {
    const LinePoint at = line_point(line, range.at(best));
    const Vec3 d = at.C - p;
    const double step = -d.dot(at.C1) / ((at.C1.squaredNorm() + d.dot(at.C2)) * range.length());
    if (!std::isfinite(step)) break;
    best += std::clamp(step, -0.02, 0.02);
    if (!closed) best = std::clamp(best, 0.0, 1.0);
    if (std::abs(step) < 1e-14) break;
  }
  return best;
}

/// v of `line` at the point of `other` at fraction t, as a fraction of the range.
struct StartMap {
  const Correspondence &start, &even;
  /// The fractions of the start's lines at the fraction t of the length of line 0.
  [[nodiscard]] double on_start(double t) const {
    const Vec3 p = line_point(even.line0, even.line0.domain().v.at(t)).C;
    return fraction_of(start.line0, p, t);
  }
  /// g(t) of the start.
  [[nodiscard]] double operator()(double t) const {
    const Vec3 p = line_point(start.line1, start.line1.domain().v.at(on_start(t))).C;
    return fraction_of(even.line1, p, t);
  }
};

std::string number_name(const std::string& what, double t) { return what + " at " + number_text(t, 4); }

class Builder {
 public:
  Builder(FitInput input, const Blend& start, const ShapeFitOptions& options)
      : blend_(start), options_(options) {
    p_.input = std::move(input);
    p_.start = p_.input.spec;
  }

  FitProblem run() && {
    const int order = order_of(p_.input);
    Layout layout;
    layout.shape = shape_unknown(p_.input, options_.unknowns);
    add_shape(order, layout.shape);
    std::shared_ptr<const BoundaryRows> rows;
    if (p_.input.ends) {
      rows = literal_rows((*p_.input.ends)[0], (*p_.input.ends)[1], p_.start.shape.anchor);
    } else {
      rows = rows_of_lines(layout);
    }
    p_.model = std::make_unique<BlendModel>(rows, p_.input.spec.shape, order, layout);
    if (rows->table_error() > 1e-6)
      p_.warnings.push_back("the trimlines bend so sharply that the fit sees them only to " +
                            scientific_text(rows->table_error()) +
                            " of their size; what is reported is measured on the blend itself");
    for (std::size_t i = 0; i < p_.x0.size(); ++i) {
      const double inside = p_.unknowns[i].bounds.clamp(p_.x0[i]);
      if (inside == p_.x0[i]) continue;
      p_.warnings.push_back(p_.unknowns[i].name + " starts at " +
                            number_text(p_.unknowns[i].value(p_.x0[i]), 6) + ", outside its bounds; " +
                            number_text(p_.unknowns[i].value(inside), 6) + " is taken");
      p_.x0[i] = inside;
    }
    return std::move(p_);
  }

 private:
  void add(Unknown u, double x0) {
    p_.scale.push_back(u.kind == Unknown::Kind::scaled ? u.scale : 1.0);
    p_.unknowns.push_back(std::move(u));
    p_.x0.push_back(x0);
  }

  void add_shape(int order, ShapeUnknown unknown) {
    const std::vector<double> x = shape_values(p_.input.spec.shape, order, unknown);
    const Interval q = options_.bounds.tension;
    const auto bounds = [](double lo, double hi) { return Interval{std::log1p(lo), std::log1p(hi)}; };
    const Interval root = bounds(q.lo * q.lo, q.hi * q.hi);
    using Kind = Unknown::Kind;
    if (unknown == ShapeUnknown::tension) add({"shape/tension", Kind::root, 1.0, root}, x[0]);
    if (unknown == ShapeUnknown::tension_per_component)
      for (std::size_t i = 0; i < 3; ++i)
        add({std::string("shape/tension of ") + "xyz"[i], Kind::root, 1.0, root}, x[i]);
    if (unknown != ShapeUnknown::coefficients) return;
    add({"shape/c", Kind::minus_c, 1.0, bounds(0.0, 2.0 * q.hi * q.hi)}, x[0]);
    add({"shape/d", Kind::d, 1.0, bounds(0.0, std::pow(q.hi, 4.0))}, x[1]);
  }

  std::shared_ptr<const BoundaryRows> rows_of_lines(Layout& layout) {
    Correspondence lines = *blend_.correspondence;
    const bool closed = lines.line0.domain().closed;
    std::optional<Correspondence> even;
    if (options_.unknowns.correspondence > 0) {
      CorrespondenceSpec spec;
      spec.reverse = lines.reversed;
      if (closed) spec.seam_offset = arranged_offset(lines);
      even = correspond((*p_.input.lines)[0], (*p_.input.lines)[1], spec);
      p_.start.correspondence = spec;
      p_.start.correspondence.rule = CorrespondenceRule::mapped;
      layout.mapped = true;
    }
    const auto map = [&] { return StartMap{*blend_.correspondence, *even}; };
    for (std::size_t i = 0; i < 2; ++i)
      layout.law[i] = law(i, closed, [&](double t) { return even ? map().on_start(t) : t; });
    for (std::size_t i = 0; i < 2; ++i) add_angle(i, layout);
    if (even) add_map(layout, closed, map());
    return line_rows(even ? *even : lines, blend_.tangents->kept_left, p_.start.sides, layout,
                     p_.start.shape.anchor);
  }

  /// The seam offset before a map: maps of the start count from there.
  [[nodiscard]] double arranged_offset(const Correspondence& lines) const {
    const CorrespondenceSpec& given = p_.input.spec.correspondence;
    if (given.rule == CorrespondenceRule::mapped && given.seam_offset) return *given.seam_offset;
    return lines.seam_offset;
  }

  /// m / (f |De|) of the rule at the fraction t of the start.
  [[nodiscard]] double ratio(std::size_t side, double t) const {
    const Interval range = blend_.surface.domain().v;
    const double v = range.at(t);
    const EndSeries e0 = blend_.surface.end(0).series(v), e1 = blend_.surface.end(1).series(v);
    const double chord = (derivative(e1.C, 0) - derivative(e0.C, 0)).norm();
    const double m = derivative(side == 0 ? e0.T : e1.T, 0).norm();
    return m / chord /
           FactorLaw(p_.input.spec.sides[side].factor, {{0.0, 1.0}, blend_.surface.domain().v_closed})(t);
  }

  template <class ToStart>
  LinearLaw law(std::size_t side, bool closed, const ToStart& on_start) {
    SideSpec& spec = p_.start.sides[side];
    const int n = options_.unknowns.magnitudes[side];
    const FactorLaw given(p_.input.spec.sides[side].factor, {{0.0, 1.0}, closed});
    const bool sampled =
        spec.rule == MagnitudeRule::arc_length || spec.rule == MagnitudeRule::minimum_bending;
    // These two rules depend on both factors; the fit sees what they made as a law of the chord.
    const auto value = [&](double t) {
      const double at = on_start(t);
      return sampled ? given(at) * ratio(side, at) : given(at);
    };
    const std::string name = side == 0 ? "from" : "to";
    if (n == 0 && !sampled) {
      if (options_.unknowns.correspondence > 0)
        for (LawPoint& p : spec.factor) p.value = value(p.t);
      return LinearLaw(spec.factor, closed);
    }
    const std::vector<double> t =
        sampled ? law_places({}, n == 0 ? 24 : n, closed) : law_places(spec.factor, n, closed);
    std::vector<LawPoint> points;
    for (const double at : t) points.push_back({at, value(at)});
    if (t.size() == 1) points[0].value = mean(value);
    if (sampled) {
      spec.rule = MagnitudeRule::chord;
      p_.warnings.push_back(name +
                            ": magnitudes that were solved for along v are given as a law of the chord");
    }
    spec.factor = points;
    if (n == 0) return LinearLaw(points, closed);
    const double scale = mean(value);
    for (std::size_t j = 0; j < t.size(); ++j) {
      const double chords = sampled ? 1.0 : ratio(side, on_start(t[j]));
      const Interval m = options_.bounds.magnitude;
      add({t.size() == 1 ? name + "/magnitude" : number_name(name + "/magnitude", t[j]),
           Unknown::Kind::scaled,
           scale,
           {m.lo / chords / scale, m.hi / chords / scale}},
          points[j].value / scale);
    }
    return LinearLaw::unknown(t, closed);
  }

  template <class F>
  static double mean(const F& value) {
    double sum = 0.0;
    for (int i = 0; i < 32; ++i) sum += value((i + 0.5) / 32.0) / 32.0;
    return sum;
  }

  void add_angle(std::size_t side, Layout& layout) {
    layout.angle[side] = options_.unknowns.tangent_angle[side];
    if (!layout.angle[side]) return;
    const double most = options_.bounds.tangent_angle.value;
    add({side == 0 ? "from/tangent_angle" : "to/tangent_angle", Unknown::Kind::scaled, 1.0, {-most, most}},
        p_.start.sides[side].tangent_angle.value);
  }

  void add_map(Layout& layout, bool closed, const StartMap& start) {
    const int n = options_.unknowns.correspondence;
    std::vector<double> t;
    for (int j = 0; j < n; ++j) t.push_back(closed ? static_cast<double>(j) / n : (j + 1.0) / (n + 1.0));
    layout.map = LinearLaw::unknown(t, closed, !closed);
    const double step = 1.0 / (n + (closed ? 0 : 1));
    double last = 0.0;
    for (const double at : t) {
      double g = start(at);
      if (closed && at > 0.0) g -= std::round(g - last - step);  // the turn that follows the value before
      last = g;
      p_.start.correspondence.map.push_back({at, g});
      // As a difference from t, in steps between the values: two steps are beyond what can increase.
      const double beyond = (g - at) / step;
      Unknown u{
          number_name("correspondence", at), Unknown::Kind::scaled, step, {beyond - 2.0, beyond + 2.0}, at};
      if (!closed) u.bounds = {-at / step, (1.0 - at) / step};
      add(std::move(u), beyond);
    }
  }

  FitProblem p_;
  const Blend& blend_;
  const ShapeFitOptions& options_;
};

}  // namespace

Blend FitInput::made(const BlendSpec& s) const {
  if (lines) return make_blend((*lines)[0], (*lines)[1], s, tolerance);
  return make_literal_blend((*ends)[0], (*ends)[1], s.shape);
}

double Unknown::value(double x) const {
  switch (kind) {
    case Kind::root:
      return std::sqrt(std::expm1(x));
    case Kind::minus_c:
      return -std::expm1(x);
    case Kind::d:
      return std::expm1(x);
    case Kind::scaled:
      break;
  }
  return offset + scale * x;
}

double Unknown::slope(double x) const {
  switch (kind) {
    case Kind::root:
      return 0.5 * std::exp(x) / std::sqrt(std::expm1(x));
    case Kind::minus_c:
      return -std::exp(x);
    case Kind::d:
      return std::exp(x);
    case Kind::scaled:
      break;
  }
  return scale;
}

Interval Unknown::value_bounds() const {
  const double a = value(bounds.lo), b = value(bounds.hi);
  return {std::min(a, b), std::max(a, b)};
}

BlendSpec FitProblem::spec(const double* x) const {
  BlendSpec s = start;
  const Layout& layout = model->layout();
  s.shape = model->shape(x);
  for (std::size_t i = 0; i < 2; ++i) {
    if (layout.law[i].unknowns() > 0) {
      s.sides[i].factor.clear();
      for (std::size_t j = 0; j < layout.law[i].unknowns(); ++j)
        s.sides[i].factor.push_back({layout.law[i].places()[j], x[layout.law_start(i) + j]});
    }
    if (layout.angle[i]) s.sides[i].tangent_angle = Radians(x[layout.angle_start(i)]);
  }
  if (layout.mapped)
    for (std::size_t j = 0; j < layout.map.unknowns(); ++j)
      s.correspondence.map[j].value = layout.map.places()[j] + x[layout.map_start() + j];
  return s;
}

int order_of(const FitInput& input) {
  for (std::size_t i = 0; i < 2; ++i)
    if ((input.ends ? (*input.ends)[i].continuity : input.spec.sides[i].continuity) == Continuity::G2)
      return 6;
  return 4;
}

ShapeUnknown shape_unknown(const FitInput& input, const FitUnknowns& unknowns) {
  if (unknowns.coefficients) return ShapeUnknown::coefficients;
  if (unknowns.tension_per_component) return ShapeUnknown::tension_per_component;
  const bool without = order_of(input) == 6 && input.spec.shape.family == SixthOrderFamily::quintic;
  return unknowns.tension && !without ? ShapeUnknown::tension : ShapeUnknown::none;
}

FitProblem fit_problem(FitInput input, const Blend& start, const ShapeFitOptions& options) {
  return Builder(std::move(input), start, options).run();
}

}  // namespace blendwright::detail
