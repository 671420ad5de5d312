#include "parametric/rolling_ball/ball_surface.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/geometry/spline_interpolation.hpp"

namespace blendwright {
namespace {

constexpr std::size_t first_spans = 32, most_spans = 16384;

/// A closed parameter curve that gains `turn` in every round: what is left without it is periodic.
struct UnrolledCurve {
  BSplineCurve<2> periodic;
  Vec2 turn;
  [[nodiscard]] CurveDomain domain() const { return periodic.domain(); }
  [[nodiscard]] CurveJet<2> jet(double s) const {
    CurveJet<2> j = periodic.jet(s);
    const double length = periodic.domain().v.length();
    j.D[0] += turn * (s / length);
    j.D[1] += turn / length;
    return j;
  }
};

/// Nodes equally spaced in s; on an open spine the last is its end.
std::vector<double> node_parameters(const Spine& spine, std::size_t spans) {
  std::vector<double> s;
  for (std::size_t k = 0; k <= spans; ++k)
    s.push_back(spine.length() * static_cast<double>(k) / static_cast<double>(spans));
  return s;
}

/// Refines fit(s, balls) until off(curve, ball) is within the tolerance half-way between all nodes.
template <class Fit, class Off>
auto refined(const Spine& spine, double tolerance, Fit fit, Off off) {
  if (!(tolerance > 0.0)) throw InputError("tolerance", "is " + number_text(tolerance) + ", must be > 0");
  std::vector<SpinePoint> balls;
  for (double s : node_parameters(spine, first_spans)) balls.push_back(spine.at(s));
  for (std::size_t spans = first_spans;; spans *= 2) {
    const std::vector<double> s = node_parameters(spine, spans);
    const auto curve = fit(s, balls);
    std::vector<SpinePoint> finer;
    double worst = 0.0;
    for (std::size_t k = 0; k < spans; ++k) {
      finer.push_back(balls[k]);
      finer.push_back(spine.at(0.5 * (s[k] + s[k + 1])));
      worst = std::max(worst, off(curve, finer.back()));
    }
    finer.push_back(balls.back());
    if (worst <= tolerance) return std::pair(curve, worst);
    if (spans >= most_spans)
      throw ConvergenceError("the edge of the rolling ball is within " + scientific_text(worst) +
                             " only, with " + std::to_string(spans) + " spans; the tolerance is " +
                             scientific_text(tolerance));
    balls = std::move(finer);
  }
}

template <int Dim, class Value>
BSplineCurve<Dim> interpolated(const Spine& spine, const std::vector<double>& s,
                               const std::vector<SpinePoint>& balls, Value value) {
  std::vector<Eigen::Matrix<double, Dim, 1>> points;
  for (std::size_t k = 0; k < balls.size() - (spine.closed() ? 1 : 0); ++k) points.push_back(value(balls[k]));
  return interpolate_points<Dim>(points, s, spine.closed());
}

Vec3 cross_at(const Spine& spine, const SpinePoint& ball, std::size_t side) {
  return ball_surface(spine, ball, static_cast<double>(side)).Xt;
}

/// A curve on the primary with the velocity T has T.(-W T) of its second derivative along n.
Vec3 bend_at(const Spine& spine, const SpinePoint& ball, std::size_t side) {
  const BallFoot& foot = ball.feet[side];
  const Vec3 T = cross_at(spine, ball, side);
  return -T.dot(foot.bend * T) * foot.normal;
}

}  // namespace

BallSurfacePoint ball_surface(const Spine& spine, const SpinePoint& ball, double t) {
  const double r = spine.radius();
  const auto side_of = [&](std::size_t i) { return std::copysign(1.0, -spine.pair().radius[i]); };
  const Vec3 c1 = ball.speed * ball.tangent;
  const Vec3 d1 = side_of(0) * ball.feet[0].normal, d2 = side_of(1) * ball.feet[1].normal;
  const Vec3 d1s = side_of(0) * (ball.feet[0].turn * c1), d2s = side_of(1) * (ball.feet[1].turn * c1);
  const Vec3 w = d1.cross(d2), ws = d1s.cross(d2) + d1.cross(d2s);
  const double sine = w.norm(), phi = ball.arc.value;
  const Vec3 B = w / sine, Bs = (ws - B * B.dot(ws)) / sine;
  const double phi_s = -(d1s.dot(d2) + d1.dot(d2s)) / sine;
  const Vec3 e2 = B.cross(d1), e2s = Bs.cross(d1) + B.cross(d1s);
  const double x = std::cos(t * phi), y = std::sin(t * phi);
  const Vec3 d = x * d1 + y * e2, along = x * e2 - y * d1;
  return {ball.centre + r * d, c1 + r * (x * d1s + y * e2s + t * phi_s * along), r * phi * along, d};
}

BallSurfacePoint ball_surface(const Spine& spine, double s, double t) {
  return ball_surface(spine, spine.at(s), t);
}

EndCondition BallBoundary::end(Continuity continuity) const {
  const auto series = [*this](double v) {
    return EndSeries{to_series<3>(line.jet(v)), to_series<3>(cross.jet(v)), to_series<3>(bend.jet(v))};
  };
  return {line.domain(), continuity, series};
}

BallBoundary ball_boundary(const Spine& spine, std::size_t side, double tolerance) {
  struct Curves {
    BSplineCurve<3> line, cross, bend;
  };
  const auto foot = [&](const SpinePoint& b) { return b.feet[side].point; };
  const auto cross = [&](const SpinePoint& b) { return cross_at(spine, b, side); };
  const auto bend = [&](const SpinePoint& b) { return bend_at(spine, b, side); };
  const auto fit = [&](const std::vector<double>& s, const std::vector<SpinePoint>& balls) {
    return Curves{interpolated<3>(spine, s, balls, foot), interpolated<3>(spine, s, balls, cross),
                  interpolated<3>(spine, s, balls, bend)};
  };
  // All three have the dimension of a length: they belong to a parameter across the blend.
  const auto off = [&](const Curves& c, const SpinePoint& b) {
    return std::max({(c.line.jet(b.s).C() - foot(b)).norm(), (c.cross.jet(b.s).C() - cross(b)).norm(),
                     (c.bend.jet(b.s).C() - bend(b)).norm()});
  };
  const auto [curves, worst] = refined(spine, tolerance, fit, off);
  return {curves.line, curves.cross, curves.bend, worst};
}

Trimline ball_trimline(const Spine& spine, std::size_t side, double tolerance) {
  const Surface* surface = spine.pair().primaries[side].surface();
  if (!surface)
    throw GeometryError("a trimline needs a surface, this primary of the rolling ball is a field");
  const Vec2 turn = spine.turns()[side];
  const auto at = [&](const SpinePoint& b) {
    return Vec2(Vec2(b.feet[side].at.u, b.feet[side].at.v) - turn * (b.s / spine.length()));
  };
  const auto fit = [&](const std::vector<double>& s, const std::vector<SpinePoint>& balls) {
    return UnrolledCurve{interpolated<2>(spine, s, balls, at), turn};
  };
  const auto off = [&](const UnrolledCurve& c, const SpinePoint& b) {
    const Vec2 uv = c.jet(b.s).C();
    return (surface->point({uv[0], uv[1]}) - b.feet[side].point).norm();
  };
  const auto [curve, worst] = refined(spine, tolerance, fit, off);
  return Trimline(*surface, curve, tolerance);
}

}  // namespace blendwright
