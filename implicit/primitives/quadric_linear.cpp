#include "implicit/primitives/quadric_linear.hpp"

#include <cmath>

#include "implicit/eval/linear_rules.hpp"

namespace blendwright::detail {
namespace {

constexpr double round_off = std::numeric_limits<double>::epsilon();

/// What rounding can change of Q over a box, its coordinates being uncertain by `slack`.
double rounding_of(const QuadricCoefficients& a, const Box& box, const Vec3& slack) {
  QuadricCoefficients m{};
  for (std::size_t i = 0; i < 10; ++i) m[i] = std::abs(a[i]);
  const Vec3 x = box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs());
  const Vec3 steepest(2.0 * m[0] * x[0] + m[3] * x[1] + m[4] * x[2] + m[6],
                      m[3] * x[0] + 2.0 * m[1] * x[1] + m[5] * x[2] + m[7],
                      m[4] * x[0] + m[5] * x[1] + 2.0 * m[2] * x[2] + m[8]);
  return 48.0 * round_off * (0.5 * (steepest.dot(x) + m[6] * x[0] + m[7] * x[1] + m[8] * x[2]) + m[9]) +
         2.0 * steepest.dot(slack);
}

/// The terms of second order for |x_i| <= reach_i: per axis, and the magnitudes of the cross terms.
Range second_order(const QuadricCoefficients& a, const Vec3& reach) {
  const double cross = std::abs(a[3]) * reach[0] * reach[1] + std::abs(a[4]) * reach[0] * reach[2] +
                       std::abs(a[5]) * reach[1] * reach[2];
  Range range{-cross, cross};
  for (int i = 0; i < 3; ++i) {
    const double square = a[static_cast<std::size_t>(i)] * reach[i] * reach[i];
    (square < 0.0 ? range.lo : range.hi) += square;
  }
  return range;
}

/// w max(q + c, 0)^k and its derivative by q.
struct PowerAt {
  double value, slope;
  PowerAt(const Perturbation& b, double q) {
    const double t = std::max(q + b.free_term, 0.0), low = std::pow(t, b.power - 1);
    value = b.weight * low * t;
    slope = b.weight * b.power * low;
  }
};

LinearBound bound_of(const Perturbation& b, const LinearBound& q, Range range) {
  if (range.hi + b.free_term <= 0.0) return {};
  const PowerAt at(b, q.value), lo(b, range.lo), hi(b, range.hi);
  const AtThree values{at.value, at.slope, lo.value, hi.value};
  const double slack = 4.0 * range_slack * std::max(std::abs(hi.value), std::abs(at.value));
  return b.weight > 0.0 ? of_convex(q, range, values, slack) : of_concave(q, range, values, slack);
}

}  // namespace

QuadricCoefficients remapped(const QuadricCoefficients& a, const Vec3& c, const Eigen::Matrix3d& n) {
  Frame frame;
  frame.matrix = n.transpose();
  frame.offset = c;
  frame.identity = false;
  return seen_through(a, frame);
}

LinearBound quadric_linear(const void* body, const LinearInput& in) {
  const QuadricCoefficients& a = static_cast<const Quadric*>(body)->a;
  const QuadricCoefficients t = remapped(a, in.centre, in.axes);
  const Vec3 reach = in.axes.cwiseAbs().rowwise().sum();
  const Range along_box = second_order(t, Vec3::Ones()), along_axes = second_order(a, reach);
  const LinearBound bound{t[9],
                          {t[6], t[7], t[8]},
                          {std::max(along_box.lo, along_axes.lo), std::min(along_box.hi, along_axes.hi)}};
  return bound.widened(rounding_of(a, in.local, in.slack));
}

LinearBound perturbation_linear(const void* body, const LinearInput& in) {
  return bound_of(*static_cast<const Perturbation*>(body), in.args[0], in.ranges[0]);
}

LinearBound added_perturbation_linear(const void* body, const LinearInput& in) {
  return in.args[0] + bound_of(static_cast<const AddedPerturbation*>(body)->added, in.args[1], in.ranges[1]);
}

LinearBound added_quadric_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const AddedQuadric*>(body);
  return in.args[0] + bound_of(b.added, quadric_linear(&b.q, in), quadric_range(b.q.a, in.local));
}

}  // namespace blendwright::detail
