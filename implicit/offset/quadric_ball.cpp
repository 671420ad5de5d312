#include "implicit/offset/quadric_ball.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "implicit/offset/ball_maximum.hpp"
#include "implicit/offset/local_points.hpp"

namespace blendwright {
namespace detail {
namespace {

QuadricCoefficients scaled(QuadricCoefficients a, double factor) {
  for (double& x : a) x *= factor;
  return a;
}

Eigen::Matrix3d quadratic_part(const QuadricCoefficients& a) {
  Eigen::Matrix3d m;
  m << a[0], 0.5 * a[3], 0.5 * a[4], 0.5 * a[3], a[1], 0.5 * a[5], 0.5 * a[4], 0.5 * a[5], a[2];
  return m;
}

}  // namespace

QuadricBall::QuadricBall(const QuadricCoefficients& coefficients, double r, double s)
    : q(scaled(coefficients, s)), radius(r), sign(s), axes(Eigen::Matrix3d::Identity()) {
  const Eigen::Matrix3d m = quadratic_part(q.a);
  bends = m.diagonal();
  if (!q.crossed) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(m);
  axes = eigen.eigenvectors();
  bends = eigen.eigenvalues();
}

namespace {

PointJet evaluate(const QuadricBall& b, const Vec3& x, Order order) {
  const auto& a = b.q.a;
  const Vec3 half(0.5 * (a[3] * x[1] + a[4] * x[2]), 0.5 * (a[3] * x[0] + a[5] * x[2]),
                  0.5 * (a[4] * x[0] + a[5] * x[1]));
  const Vec3 square = Vec3(a[0], a[1], a[2]).cwiseProduct(x) + half;  // S x
  const Vec3 linear(a[6], a[7], a[8]);
  const Vec3 g = b.axes.transpose() * (2.0 * square + linear);
  const BallMaximum top = maximum_on_ball(b.bends, g, b.radius);
  PointJet f;
  const double gain = top.w.dot(g + b.bends.cwiseProduct(top.w));
  f.value = b.sign * (x.dot(square + linear) + a[9] + gain);
  if (order == Order::value) return f;
  f.gradient = (2.0 * b.sign * top.l) * (b.axes * top.w);
  if (order == Order::hessian)
    f.hessian = b.sign * (b.axes * moved_hessian(b.bends, top) * b.axes.transpose());
  return f;
}

template <Order order>
void run(const void* body, const KernelInput& in, double* out) {
  const auto& b = *static_cast<const QuadricBall*>(body);
  const LocalPoints points(in);
  for (std::size_t i = 0; i < points.count; ++i) store(evaluate(b, points.at(i), order), order, in, i, out);
}

/// The upper end from the box around all balls, the lower end from the box itself and from points that lie in
/// the balls of all its points.
Range quadric_ball_range(const void* body, const Box& local, std::span<const Range>) {
  const auto& b = *static_cast<const QuadricBall*>(body);
  Range q{quadric_range(b.q.a, local).lo, quadric_range(b.q.a, inflated(local, b.radius)).hi};
  if (local.finite()) {
    // F(c') <= F(X) <= F(c'') of balls around the centre with the radii D -+ |half size|.
    const double reach = 0.5 * local.size().norm() * (1.0 + 1e-12);
    const auto at_centre = [&](double radius) {
      QuadricBall moved = b;
      moved.radius = radius;
      return b.sign * evaluate(moved, local.centre(), Order::value).value;
    };
    // Where they lie in all balls, the axes' ends give lower ends, too.
    for (int k = 0; k < 6; ++k) {
      const Vec3 shift = (k % 2 == 0 ? b.radius : -b.radius) * b.axes.col(k / 2);
      q.lo = std::max(q.lo, quadric_range(b.q.a, inflated({local.lo + shift, local.hi + shift}, 0.0)).lo);
    }
    const double terms =
        quadric_range(
            {std::abs(b.q.a[0]), std::abs(b.q.a[1]), std::abs(b.q.a[2]), std::abs(b.q.a[3]),
             std::abs(b.q.a[4]), std::abs(b.q.a[5]), std::abs(b.q.a[6]), std::abs(b.q.a[7]),
             std::abs(b.q.a[8]), std::abs(b.q.a[9])},
            {Vec3::Zero(),
             (local.lo.cwiseAbs().cwiseMax(local.hi.cwiseAbs()).array() + b.radius + reach).matrix()})
            .hi;
    const double slack = 1e-14 * terms;
    if (std::isfinite(slack)) {
      q.hi = std::min(q.hi, at_centre(b.radius + reach) + slack);
      if (b.radius > reach) q.lo = std::max(q.lo, at_centre(b.radius - reach) - slack);
    }
  }
  return b.sign > 0.0 ? q : Range{-q.hi, -q.lo};
}

}  // namespace
}  // namespace detail

template <>
const Op& op_for<detail::QuadricBall>() {
  using namespace detail;
  static constexpr KernelSet kernels{{run<Order::value>, run<Order::gradient>, run<Order::hessian>}};
  static const Op op{"quadric_ball", kernels, kernels, quadric_ball_range};
  return op;
}

}  // namespace blendwright
