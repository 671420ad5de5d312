#include "implicit/offset/ball_search.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

/// The best of points on the way to the model's maximum, for when that is no better.
Vec3 shorter_step(const Signed& f, const Vec3& from, const Vec3& to, double& value) {
  std::array<Vec3, 8> points;
  for (std::size_t k = 0; k < points.size(); ++k)
    points[k] = from + std::ldexp(1.0, -2 * static_cast<int>(k) - 1) * (to - from);
  const auto values = f.values(points);
  const auto best = static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
  value = values[best];
  return points[best];
}

/// Climbs from `start`: maxima of quadratic models, as long as they are better. At the end values no longer
/// tell, being rounded: steps count that shrink as those of Newton's method do.
Peak climb(const Signed& f, const Vec3& x, double radius, const Vec3& start) {
  constexpr int most_steps = 40;
  Peak peak{start, f.jet(Order::hessian, start)};
  add_model(peak, x, radius);
  double last_step = radius;
  for (int k = 0; k < most_steps; ++k) {
    Vec3 next = x + peak.axes * peak.model.w;
    double step = (next - peak.at).norm();
    if (!(step > epsilon * radius) || !next.allFinite()) break;
    const bool final_steps = step < 1e-6 * radius;
    if (final_steps && !(step < 0.5 * last_step)) break;
    PointJet there = f.jet(Order::hessian, next);
    if (!final_steps && !(there.value >= peak.f.value)) {
      double value = 0.0;
      next = shorter_step(f, peak.at, next, value);
      if (!(value > peak.f.value)) break;
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

/// Derivatives of F at x from the peak: the gradient of f there, and (3) of ball_maximum.hpp.
PointJet moved_jet(const Peak& peak, const Vec3& x, double radius, Order order) {
  PointJet f = peak.f;
  f.hessian.setZero();
  if (order != Order::hessian) return f;
  BallMaximum top;
  const Vec3 w = peak.at - x;
  if (w.norm() < radius * (1.0 - 1e-9)) return f;  // inside: F is constant around x
  top.w = peak.axes.transpose() * w;
  top.l = peak.model.l;
  top.gaps = peak.model.gaps;
  top.tie = peak.model.tie;
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
