#include "parametric/rolling_ball/spine.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/geometry/spline_interpolation.hpp"
#include "kernel/math/quadrature.hpp"
#include "parametric/rolling_ball/ball_contact.hpp"
#include "parametric/rolling_ball/spine_trace.hpp"
#include "parametric/trimline/line_point.hpp"

namespace blendwright {

/// The interpolating curve b(s), which gives the spine its parameter: the ball at s has its centre in the
/// plane through b(s) across b'(s).
class Spine::Base {
 public:
  explicit Base(BSplineCurve<3> curve) : curve_(std::move(curve)) {}
  [[nodiscard]] CurveJet<3> jet(double s) const { return curve_.jet(s); }

  /// Degree 5, or what few points allow.
  static Base through(const std::vector<SpinePoint>& points, bool closed, double length) {
    std::vector<Vec3> centres;
    std::vector<double> s;
    for (const SpinePoint& p : points) {
      centres.push_back(p.centre);
      s.push_back(p.s);
    }
    if (closed) s.push_back(length);
    const int degree = points.size() >= 6 ? 5 : points.size() >= 4 ? 3 : 1;
    return Base(interpolate_points<3>(centres, s, closed, degree));
  }

 private:
  BSplineCurve<3> curve_;
};

namespace {

/// Arc length between two points of a curve from its chord and the turn of its tangent: that of a circle.
double arc_length(const SpinePoint& a, const SpinePoint& b) {
  const double half = 0.5 * std::atan2(a.tangent.cross(b.tangent).norm(), a.tangent.dot(b.tangent));
  const double chord = (b.centre - a.centre).norm();
  return half > 1e-4 ? chord * half / std::sin(half) : chord * (1.0 + half * half / 6.0);
}

}  // namespace

const char* name(BallFailure::Cause cause) {
  using enum BallFailure::Cause;
  switch (cause) {
    case tangent:
      return "tangent";
    case curvature:
      return "curvature";
    case no_spine:
      return "no_spine";
    case interference:
      return "interference";
    case domain:
      return "domain";
    case lost:
      return "lost";
  }
  return "lost";
}

SpinePoint spine_point(const BallPair& pair, const BallContact& contact) {
  SpinePoint p;
  p.centre = contact.c;
  p.tangent = spine_tangent(contact);
  p.curvature = spine_curvature(contact);
  p.feet = contact.feet;
  const Vec3 d1 = std::copysign(1.0, -pair.radius[0]) * contact.feet[0].normal;
  const Vec3 d2 = std::copysign(1.0, -pair.radius[1]) * contact.feet[1].normal;
  p.arc = Radians(std::atan2(d1.cross(d2).norm(), d1.dot(d2)));
  p.residual = residual(pair, contact);
  return p;
}

Spine::Spine(BallPair pair, std::vector<SpinePoint> points, bool closed, std::array<Vec2, 2> turns,
             std::array<SpineEnd, 2> ends)
    : pair_(std::move(pair)),
      points_(std::move(points)),
      closed_(closed),
      turns_(turns),
      ends_(std::move(ends)) {
  if (points_.size() < 2) throw InputError("points", "are fewer than 2, a spine needs 2");
  for (std::size_t k = 1; k < points_.size(); ++k)
    points_[k].s = points_[k - 1].s + arc_length(points_[k - 1], points_[k]);
  length_ = points_.back().s + (closed_ ? arc_length(points_.back(), points_.front()) : 0.0);
  measure();
}

/// Arc lengths by quadrature of |dc/ds| on a first base curve; the final one runs through the points at
/// these.
void Spine::measure() {
  base_ = std::make_shared<const Base>(Base::through(points_, closed_, length_));
  constexpr int nodes = 5;
  const QuadratureRule& rule = gauss_legendre(nodes);
  std::vector<double> s{0.0};
  const std::size_t segments = points_.size() - (closed_ ? 0 : 1);
  for (std::size_t k = 0; k < segments; ++k) {
    const double lo = points_[k].s, hi = k + 1 < points_.size() ? points_[k + 1].s : length_;
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.x.size(); ++i) sum += rule.w[i] * at(lo + rule.x[i] * (hi - lo)).speed;
    s.push_back(s.back() + sum * (hi - lo));
  }
  for (std::size_t k = 0; k < points_.size(); ++k) points_[k].s = s[k];
  length_ = s.back();
  base_ = std::make_shared<const Base>(Base::through(points_, closed_, length_));
}

SpinePoint Spine::at(double s) const {
  const CurveDomain domain{{0.0, length_}, closed_};
  const Wrapped w = wrapped(domain, s);
  const double inside = closed_ ? w.inside : domain.v.clamp(s);
  const auto above = std::upper_bound(points_.begin() + 1, points_.end(), inside,
                                      [](double x, const SpinePoint& p) { return x < p.s; });
  const std::size_t k = static_cast<std::size_t>(above - points_.begin()) - 1;
  const bool closing = k + 1 == points_.size();
  const SpinePoint& a = points_[k];
  const SpinePoint& b = closing ? (closed_ ? points_.front() : points_.back()) : points_[k + 1];
  const double end = closing ? length_ : b.s;
  const double x = end > a.s ? (inside - a.s) / (end - a.s) : 0.0;
  std::array<BallFoot, 2> near = a.feet;
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec2 turn = closing && closed_ ? turns_[i] : Vec2(0.0, 0.0);
    near[i].point += x * (b.feet[i].point - a.feet[i].point);
    near[i].at.u += x * (b.feet[i].at.u + turn[0] - a.feet[i].at.u);
    near[i].at.v += x * (b.feet[i].at.v + turn[1] - a.feet[i].at.v);
  }
  const CurveJet<3> base = base_->jet(inside);
  const Corrected found = corrected_in_plane(pair_, base.C(), base.C(), base.C1(), near);
  const auto* contact = std::get_if<BallContact>(&found);
  if (!contact)
    throw ConvergenceError("the rolling ball is lost at s = " + std::to_string(inside) + " near " +
                           point_text(base.C()) + ": " + name(std::get<BallFailure::Cause>(found)));
  SpinePoint p = spine_point(pair_, *contact);
  p.s = s;
  // d/ds of (c - b).b' = 0 with c' = speed T.
  p.speed = (base.C1().squaredNorm() - (p.centre - base.C()).dot(base.C2())) / p.tangent.dot(base.C1());
  for (std::size_t i = 0; i < 2; ++i) {
    p.feet[i].at.u += w.turns * turns_[i][0];
    p.feet[i].at.v += w.turns * turns_[i][1];
  }
  return p;
}

double Spine::nearest(const Vec3& c) const {
  const auto closest =
      std::min_element(points_.begin(), points_.end(), [&](const SpinePoint& a, const SpinePoint& b) {
        return (a.centre - c).squaredNorm() < (b.centre - c).squaredNorm();
      });
  double s = closest->s;
  // Newton on (c - x(s)).T = 0; the turn of T counts for points off the spine only, and there slows it.
  for (int k = 0; k < 40; ++k) {
    const SpinePoint p = at(s);
    double step = (c - p.centre).dot(p.tangent) / p.speed;
    step = std::clamp(step, -0.1 * length_, 0.1 * length_);
    const double next = closed_ ? s + step : std::clamp(s + step, 0.0, length_);
    const double moved = std::abs(next - s);
    s = next;
    if (moved <= 1e-15 * length_) break;
  }
  return wrapped({{0.0, length_}, closed_}, s).inside;
}

}  // namespace blendwright
