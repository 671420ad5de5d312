// What can be wrong with an intent, found before anything is built and then against the start.
#include <algorithm>
#include <cmath>

#include "kernel/base/number_text.hpp"
#include "parametric/shape_fit/fit_problem.hpp"

namespace blendwright::detail {
namespace {

using Problems = std::vector<Problem>;

class Checker {
 public:
  Checker(const FitInput& input, const ShapeFitOptions& options) : input_(input), options_(options) {}

  Problems run() && {
    unknowns();
    shape();
    bounds();
    objectives();
    numbers();
    return std::move(problems_);
  }

 private:
  void add(std::string where, std::string message) {
    problems_.push_back({std::move(where), std::move(message)});
  }
  /// A number that must be finite and at least (above) `least`.
  void number(const std::string& where, double x, double least, bool strictly, const char* what) {
    if (std::isfinite(x) && (strictly ? x > least : x >= least)) return;
    add(where, std::string("is ") + number_text(x) + ", " + what + " must be " + (strictly ? "> " : ">= ") +
                   number_text(least));
  }
  void range(const std::string& where, int x, int lo, int hi) {
    if (x >= lo && x <= hi) return;
    add(where, std::string("is ") + std::to_string(x) + ", must lie in [" + std::to_string(lo) + ", " +
                   std::to_string(hi) + "]");
  }

  void unknowns() {
    const FitUnknowns& u = options_.unknowns;
    range("unknowns/magnitudes/0", u.magnitudes[0], 0, 64);
    range("unknowns/magnitudes/1", u.magnitudes[1], 0, 64);
    range("unknowns/correspondence", u.correspondence, 0, 64);
    const bool sixth = order_of(input_) == 6;
    if (u.tension_per_component && sixth)
      add("unknowns/tension_per_component",
          "belongs to fourth order, but a side asks G2, which makes it sixth; ask for one tension");
    if (u.coefficients && sixth)
      add("unknowns/coefficients",
          "(c, d) belong to fourth order, but a side asks G2, which makes it sixth; ask for the tension");
    if (u.coefficients && u.tension_per_component)
      add("unknowns/coefficients", "excludes tension_per_component: both say what (c, d) are; leave one out");
    for (std::size_t i = 0; input_.lines && i < 2; ++i)
      if (u.tangent_angle[i] && input_.spec.sides[i].continuity == Continuity::G0)
        add(std::string("unknowns/tangent_angle/") + std::to_string(i),
            "is free, but the side asks G0 only, where the tangent follows the chord; ask G1 or leave it "
            "out");
    if (input_.ends && (u.tangent_angle[0] || u.tangent_angle[1]))
      add("unknowns/tangent_angle", "is free, but the tangents are given by formulas; leave it out");
    if (input_.ends && u.correspondence > 0)
      add("unknowns/correspondence", "is free, but the boundary curves are given by formulas; leave it out");
    const bool sides = input_.lines && (u.magnitudes[0] > 0 || u.magnitudes[1] > 0 || u.tangent_angle[0] ||
                                        u.tangent_angle[1] || u.correspondence > 0);
    if (!sides && shape_unknown(input_, u) == ShapeUnknown::none)
      add("unknowns", quintic()
                          ? "are none: the quintic family has no tension; take the family tension1 or free "
                            "the magnitudes"
                          : "are none, so that nothing can change; free at least one");
  }

  [[nodiscard]] bool quintic() const {
    return order_of(input_) == 6 && input_.spec.shape.family == SixthOrderFamily::quintic &&
           options_.unknowns.tension;
  }

  void shape() {
    const BlendShape& s = input_.spec.shape;
    if (order_of(input_) == 6) return;
    if (s.frame == BlendFrame::moving &&
        (!s.isotropic() || shape_unknown(input_, options_.unknowns) == ShapeUnknown::tension_per_component))
      add("shape/frame",
          "is moving and the components have their own coefficients, which a fit cannot follow; "
          "take a fixed frame or equal coefficients");
    if (s.repeated_root) {
      if (!(*s.repeated_root >= 0.0 && std::isfinite(*s.repeated_root)))
        add("shape/q", std::string("is ") + number_text(*s.repeated_root) + ", must be >= 0");
      return;
    }
    const ShapeUnknown unknown = shape_unknown(input_, options_.unknowns);
    if (unknown == ShapeUnknown::none) return;
    if (unknown != ShapeUnknown::tension_per_component && !s.isotropic())
      return add("shape", "has its own coefficients per component; ask for tension_per_component");
    for (const SweepOde& ode : s.ode) {
      const double p = -ode.c / ode.b, d = ode.d / ode.b;
      if (!std::isfinite(p) || !std::isfinite(d)) return;  // said when the start is built
      const bool single = ode.d == 0.0 || std::abs(p * p - 4.0 * d) <= 1e-9 * p * p;
      if (unknown == ShapeUnknown::coefficients && !(p >= 0.0 && d >= 0.0))
        return add("shape", "starts at c/b = " + number_text(-p) + ", d/b = " + number_text(d) +
                                "; a fit stays where no resonance is, c/b <= 0 and d/b >= 0: start there");
      if (unknown != ShapeUnknown::coefficients && !(single && p >= 0.0))
        return add("shape",
                   "has b, c, d without a single root (c^2 = 4bd with c/b <= 0, or d = 0), so there is no "
                   "tension to change; give q, or ask for coefficients");
    }
  }

  void interval(const std::string& where, const Interval& i, double least) {
    if (std::isfinite(i.lo) && std::isfinite(i.hi) && i.lo >= least && i.lo < i.hi) return;
    add(where, std::string("is [") + number_text(i.lo) + ", " + number_text(i.hi) +
                   "], must be two finite numbers >= " + number_text(least) + ", the smaller one first");
  }

  void bounds() {
    const FitBounds& b = options_.bounds;
    interval("bounds/tension", b.tension, 0.0);
    if (b.tension.hi > 70.0)
      add("bounds/tension",
          "goes up to " + number_text(b.tension.hi) +
              ", must stay <= 70: beyond, the layers at the trimlines are thinner than they are exact");
    interval("bounds/magnitude", b.magnitude, 1e-6);
    if (!(b.tangent_angle.value > 0.0 && b.tangent_angle <= Radians(degrees(60.0).value * (1.0 + 1e-12))))
      add("bounds/tangent_angle",
          std::string("is ") + number_text(b.tangent_angle.degrees()) + " deg, must lie in (0, 60] deg");
    if (!(b.least_speed > 0.0 && b.least_speed < 1.0))
      add("bounds/least_speed", std::string("is ") + number_text(b.least_speed) + ", must lie in (0, 1)");
    number("bounds/prior", b.prior, 0.0, false, "a weight");
  }

  void numbers() {
    range("samples_u", options_.samples_u, 2, 64);
    range("samples_v", options_.samples_v, 4, 1'000'000);
    range("max_iterations", options_.max_iterations, 1, 100'000);
    range("starts", options_.starts, 1, 1000);
    range("threads", options_.threads, 1, 4096);
  }

  void objectives() {
    if (options_.objectives.empty())
      return add("objectives", "are none, so that nothing is wanted; give at least one");
    bool any = false, good = true;
    for (std::size_t k = 0; k < options_.objectives.size(); ++k) {
      where_ = std::string("objectives/") + std::to_string(k);
      const double w = std::visit([](const auto& o) { return o.weight; }, options_.objectives[k]);
      number(where_ + "/weight", w, 0.0, false, "a weight");
      any = any || w > 0.0;
      good = good && std::isfinite(w) && w >= 0.0;
      std::visit([this](const auto& o) { check(o); }, options_.objectives[k]);
    }
    if (!any && good)
      add("objectives", "have no weight above 0, so that nothing is wanted; give one a weight");
  }

  void check(const ThinPlate&) {}
  void check(const CurvatureVariation&) {}
  void check(const RollingBall& o) {
    const std::string at = where_ + "/radius";
    if (o.radius.empty()) add(at, "is empty, must be a radius or a law [[t, radius], ...]");
    for (std::size_t i = 0; i < o.radius.size(); ++i) {
      const std::string place = o.radius.size() == 1 ? at : at + "/" + std::to_string(i);
      number(place, o.radius[i].value, 0.0, true, "a radius");
      if (!(o.radius[i].t >= 0.0 && o.radius[i].t <= 1.0))
        add(place, "is at t = " + number_text(o.radius[i].t) + ", must lie in [0, 1]");
      if (i > 0 && !(o.radius[i].t > o.radius[i - 1].t))
        add(place, "is at t = " + number_text(o.radius[i].t) + ", must come after " +
                       number_text(o.radius[i - 1].t));
    }
    if (!(o.across.lo >= 0.0 && o.across.hi <= 1.0 && o.across.lo <= o.across.hi))
      add(where_ + "/across", std::string("is [") + number_text(o.across.lo) + ", " +
                                  number_text(o.across.hi) +
                                  "], must be a part of [0, 1], the smaller number first");
  }
  void points(const std::vector<Vec3>& p) {
    if (p.empty()) add(where_ + "/points", "are none, must be at least one point");
    for (std::size_t i = 0; i < p.size(); ++i)
      if (!p[i].allFinite())
        return add(where_ + "/points/" + std::to_string(i), "has a coordinate that is not a finite number");
  }
  void check(const PassThrough& o) { points(o.points); }
  void check(const ScannedPoints& o) {
    points(o.points);
    if (o.robust_scale) number(where_ + "/robust_scale", *o.robust_scale, 0.0, true, "a distance");
  }
  void check(const LargestCurvature& o) {
    number(where_ + "/least_radius", o.least_radius, 0.0, true, "a radius");
  }
  void check(const Clearance& o) {
    number(where_ + "/distance", o.distance, 0.0, true, "a distance");
    if (!o.obstacle) add(where_ + "/to", "is missing: there is nothing to keep clear of");
  }
  void check(const NoFold& o) {
    if (!(o.margin >= 0.0 && o.margin < 1.0))
      add(where_ + "/margin", std::string("is ") + number_text(o.margin) + ", must lie in [0, 1)");
  }

  const FitInput& input_;
  const ShapeFitOptions& options_;
  std::string where_{};
  Problems problems_{};
};

/// Corners of the blend's box.
std::array<Vec3, 2> box_of(const Blend& blend) {
  std::array<Vec3, 2> box{Vec3::Constant(HUGE_VAL), Vec3::Constant(-HUGE_VAL)};
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 64; ++j) {
      const Vec3 S = blend.surface.jet({i / 8.0, blend.surface.domain().v.at(j / 64.0)}).S;
      box[0] = box[0].cwiseMin(S);
      box[1] = box[1].cwiseMax(S);
    }
  return box;
}

std::string point_name(const Vec3& p) {
  return std::string("(") + number_text(p[0], 6) + ", " + number_text(p[1], 6) + ", " + number_text(p[2], 6) + ")";
}

void far_points(const std::array<Vec3, 2>& box, const std::vector<Vec3>& points, const std::string& where,
                Problems& problems) {
  const double size = (box[1] - box[0]).norm();
  std::size_t far = 0, worst = 0;
  double most = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double away = (points[i] - points[i].cwiseMax(box[0]).cwiseMin(box[1])).norm();
    if (away > 10.0 * size) ++far;
    if (away > most) most = away, worst = i;
  }
  if (far == 0) return;
  std::string others;
  if (far > 1) others.append(" (and ").append(std::to_string(far - 1)).append(" more)");
  problems.push_back({where + "/points/" + std::to_string(worst),
                      point_name(points[worst]) + " is " + number_text(most, 4) +
                          " from the blend, whose size is " + number_text(size, 4) + others +
                          "; points must lie within 10 sizes: check their unit"});
}

}  // namespace

std::vector<Problem> check_fit(const FitInput& input, const ShapeFitOptions& options) {
  return Checker(input, options).run();
}

std::vector<Problem> check_against(const Blend& start, const ShapeFitOptions& options) {
  Problems problems;
  const std::array<Vec3, 2> box = box_of(start);
  for (std::size_t k = 0; k < options.objectives.size(); ++k) {
    const std::string where = std::string("objectives/") + std::to_string(k);
    if (const auto* through = std::get_if<PassThrough>(&options.objectives[k]))
      far_points(box, through->points, where, problems);
    if (const auto* scan = std::get_if<ScannedPoints>(&options.objectives[k]))
      far_points(box, scan->points, where, problems);
    if (const auto* clear = std::get_if<Clearance>(&options.objectives[k])) {
      const ObstacleSample s = clear->obstacle(0.5 * (box[0] + box[1]));
      if (!std::isfinite(s.distance) || !s.gradient.allFinite())
        problems.push_back({where + "/to", "has no finite distance at " +
                                               point_name(0.5 * (box[0] + box[1])) +
                                               ", in the middle of the blend; it must have one everywhere"});
    }
  }
  return problems;
}

}  // namespace blendwright::detail
