#include "implicit/offset/ball_search.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "implicit/offset/ball_maximum.hpp"
#include "implicit/offset/ball_proof.hpp"

namespace blendwright::detail {

Vec3 search_start(std::size_t k) {
  if (k == 0) return Vec3::Zero();
  if (k < 7) return (k % 2 == 1 ? 1.0 : -1.0) * Vec3::Unit(static_cast<Eigen::Index>((k - 1) / 2));
  const std::size_t c = k - 7;
  return std::sqrt(1.0 / 3.0) * Vec3(c & 1 ? 1.0 : -1.0, c & 2 ? 1.0 : -1.0, c & 4 ? 1.0 : -1.0);
}

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// f times the sign: of which the largest value is looked for.
class Signed {
 public:
  Signed(const ScalarField::Model& field, double sign) : field_(field), sign_(sign) {}
  [[nodiscard]] PointJet jet(Order order, const Vec3& at) const {
    PointJet f = jet_at(field_, order, at);
    f.value *= sign_;
    f.gradient *= sign_;
    f.hessian *= sign_;
    return f;
  }
  template <std::size_t N>
  [[nodiscard]] std::array<double, N> values(const std::array<Vec3, N>& points) const {
    std::array<double, N> x, y, z, f;
    for (std::size_t i = 0; i < N; ++i) {
      x[i] = points[i].x();
      y[i] = points[i].y();
      z[i] = points[i].z();
    }
    field_.evaluate(Order::value, {x, y, z}, f);
    for (double& v : f) v *= sign_;
    return f;
  }

 private:
  const ScalarField::Model& field_;
  double sign_;
};

/// A local maximum in the ball and the second derivatives there, in their own axes.
struct Peak {
  Vec3 at;
  PointJet f;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Vec3 bends = Vec3::Zero();  ///< eigenvalues of half of the second derivatives
  BallMaximum model{};        ///< of the quadratic model around it: w in these axes
};

void add_model(Peak& peak, const Vec3& x, double radius) {
  const Eigen::Matrix3d S = 0.5 * peak.f.hessian;
  if (S.isZero(0.0)) {
    peak.axes.setIdentity();
    peak.bends.setZero();
  } else {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(S);
    peak.axes = eigen.eigenvectors();
    peak.bends = eigen.eigenvalues();
  }
  const Vec3 w = peak.axes.transpose() * (peak.at - x);
  const Vec3 g = peak.axes.transpose() * peak.f.gradient - 2.0 * peak.bends.cwiseProduct(w);
  peak.model = maximum_on_ball(peak.bends, g, radius);
}

/// Newton's step within the sphere around x: with n = w/|w| the second derivatives of f there are those of f
/// across n, less g.n/|w|. Null where f does not bend down.
std::optional<Vec3> step_on_sphere(const Peak& peak, const Vec3& w, double radius) {
  const Vec3 n = w / radius, a = n.unitOrthogonal(), b = n.cross(a);
  const double outward = peak.f.gradient.dot(n) / radius;
  const double haa = a.dot(peak.f.hessian * a) - outward, hbb = b.dot(peak.f.hessian * b) - outward;
  const double hab = a.dot(peak.f.hessian * b), det = haa * hbb - hab * hab;
  if (!(haa < 0.0 && det > 1e-14 * haa * haa)) return std::nullopt;
  const double ga = peak.f.gradient.dot(a), gb = peak.f.gradient.dot(b);
  return Vec3((-(hbb * ga - hab * gb) / det) * a + (-(haa * gb - hab * ga) / det) * b);
}

/// Where a search may go from a peak that is none yet.
class Ways {
 public:
  Ways(const Peak& peak, const Vec3& x, double radius)
      : peak_(peak), x_(x), w_(peak.at - x), radius_(radius) {
    const bool outside = w_.norm() >= radius * (1.0 - 1e-6) && peak.f.gradient.dot(w_) > 0.0;
    if (outside) newton_ = step_on_sphere(peak, w_, radius);
  }
  /// To the maximum nearby on the sphere, where that is near; else to that of the model, anywhere in the
  /// ball.
  [[nodiscard]] Vec3 first() const {
    if (newton_ && newton_->norm() < 1e-2 * radius_) return on_sphere(*newton_);
    return x_ + peak_.axes * peak_.model.w;
  }
  /// When that is no better: shorter and shorter steps along the sphere or to the gradient.
  [[nodiscard]] std::array<Vec3, 8> others() const {
    const Vec3& g = peak_.f.gradient;
    const double size = g.stableNorm();
    std::array<Vec3, 8> points;
    points.fill(peak_.at);
    if (!(size > 0.0)) return points;
    points[0] = x_ + (radius_ / size) * g;
    const Vec3 n = w_ / std::max(w_.norm(), 1e-300);
    const bool across = w_.norm() >= radius_ * (1.0 - 1e-6) && g.dot(n) > 0.0;
    const Vec3 along = across ? Vec3(g - n * n.dot(g)) : g;
    const double length = along.stableNorm();
    points[1] = newton_ ? on_sphere(*newton_) : points[0];
    for (std::size_t k = 2; k < points.size() && length > 0.0; ++k)
      points[k] = on_sphere((std::ldexp(radius_, 3 - 3 * static_cast<int>(k)) / length) * along);
    return points;
  }

 private:
  /// A step, back onto the sphere or into the ball.
  [[nodiscard]] Vec3 on_sphere(const Vec3& step) const {
    const Vec3 w = w_ + step;
    const double size = w.norm();
    return size > radius_ || newton_ ? Vec3(x_ + (radius_ / size) * w) : Vec3(x_ + w);
  }
  const Peak& peak_;
  Vec3 x_, w_;
  double radius_;
  std::optional<Vec3> newton_;
};

/// Climbs from `start` as long as values rise. At the end, being rounded, they no longer tell: then steps
/// count that shrink as those of Newton's method do.
Peak climb(const Signed& f, const Vec3& x, double radius, const Vec3& start) {
  constexpr int most_steps = 60;
  Peak peak{start, f.jet(Order::hessian, start)};
  add_model(peak, x, radius);
  double last_step = radius;
  for (int k = 0; k < most_steps; ++k) {
    const Ways ways(peak, x, radius);
    Vec3 next = ways.first();
    double step = (next - peak.at).norm();
    if (!(step > epsilon * radius) || !next.allFinite()) break;
    const bool final_steps = step < 1e-6 * radius;
    if (final_steps && !(step < 0.5 * last_step)) break;
    PointJet there = f.jet(Order::hessian, next);
    if (!final_steps && !(there.value >= peak.f.value)) {
      const auto others = ways.others();
      const auto values = f.values(others);
      const auto best = std::max_element(values.begin(), values.end()) - values.begin();
      if (!(values[static_cast<std::size_t>(best)] > peak.f.value)) break;
      next = others[static_cast<std::size_t>(best)];
      there = f.jet(Order::hessian, next);
      step = (next - peak.at).norm();
    }
    last_step = step;
    peak.at = next;
    peak.f = there;
    add_model(peak, x, radius);
  }
  return peak;
}

struct Start {
  Vec3 at;
  double value;  ///< the largest of all starts
  double spread;
};
/// The best of the fixed starts and of the point of the sphere along the gradient.
Start best_start(const Signed& f, const Vec3& x, double radius) {
  const Vec3 g = f.jet(Order::gradient, x).gradient;
  const double size = g.stableNorm();
  std::array<Vec3, start_count + 1> points;
  for (std::size_t k = 0; k < start_count; ++k) points[k] = x + radius * search_start(k);
  points[start_count] = size > 0.0 ? Vec3(x + (radius / size) * g) : x;
  const auto values = f.values(points);
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {points[static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin())],
          *most, *most - *least};
}

/// Derivatives of F at x from the peak: the gradient of f there, and (3) of ball_maximum.hpp. On the sphere
/// the gradient of F is along w = Y* - x; where that of f is not, Y* lies on an edge of f.
PointJet moved_jet(const Peak& peak, const Vec3& x, double radius, Order order) {
  PointJet f = peak.f;
  f.hessian.setZero();
  const Vec3 w = peak.at - x;
  if (order == Order::value || w.norm() < radius * (1.0 - 1e-9)) return f;  // inside: F is constant around x
  const Vec3 n = w / w.norm(), along = n * n.dot(f.gradient);
  if (!((f.gradient - along).norm() <= 1e-5 * along.norm())) {
    f.gradient = along;
    return f;
  }
  if (order != Order::hessian) return f;
  BallMaximum top;
  top.w = peak.axes.transpose() * w;
  top.l = f.gradient.dot(w) / (2.0 * radius * radius);
  top.gaps = (top.l - peak.bends.array()).matrix();
  f.hessian = peak.axes * moved_hessian(peak.bends, top) * peak.axes.transpose();
  return f;
}

}  // namespace

BallTop search_ball(const BallSearch& search, const Vec3& x, Order order) {
  const Box around = inflated({x, x}, search.radius);
  const auto within = search.field->within(around);
  const ScalarField::Model& field = within.model ? *within.model : *search.field;
  const Signed f(field, search.sign);
  const double top = search.sign > 0.0 ? within.range.hi : -within.range.lo;
  const Start start = best_start(f, x, search.radius);
  BallTop found;
  if (!std::isfinite(start.value)) {
    found.at = start.at;
    found.f.value = search.sign * start.value;
    found.upper = search.sign * top;
    return found;
  }
  const double width = within.range.hi - within.range.lo;
  const double allowed = search.tolerance * (std::isfinite(width) ? width : start.spread) +
                         1e-14 * (std::abs(start.value) + start.spread);
  BallProof proof(field, search.sign, {x, search.radius, around}, most_cells);
  Peak peak = climb(f, x, search.radius, start.at);
  constexpr int most_peaks = 32;
  for (int k = 0; k < most_peaks; ++k) {
    const double best = std::max(peak.f.value, start.value);
    if (top <= best + allowed) {
      found.upper = top;
      found.certain = true;
      break;
    }
    const Vec3 w = peak.at - x;
    const double l = std::max(0.0, peak.f.gradient.dot(w) / (2.0 * search.radius * search.radius));
    const BallProof::Result result = proof.run(peak.at, l, best + allowed);
    found.upper = std::min(top, std::max(result.upper, best));
    found.certain = result.kind == BallProof::Result::Kind::proven;
    if (result.kind != BallProof::Result::Kind::better) break;
    peak = climb(f, x, search.radius, result.better);
  }
  found.bounds = proof.bounds();
  found.at = peak.at;
  found.f = moved_jet(peak, x, search.radius, order);
  found.f.value = search.sign * std::max(peak.f.value, start.value);
  found.f.gradient *= search.sign;
  found.f.hessian *= search.sign;
  found.upper *= search.sign;
  return found;
}

}  // namespace blendwright::detail
