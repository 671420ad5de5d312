// Where a quadric is large.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "implicit/primitives/quadric.hpp"

namespace blendwright::detail {
namespace {

Eigen::Matrix3d quadratic_part(const QuadricCoefficients& a) {
  Eigen::Matrix3d m;
  m << a[0], 0.5 * a[3], 0.5 * a[4], 0.5 * a[3], a[1], 0.5 * a[5], 0.5 * a[4], 0.5 * a[5], a[2];
  return m;
}
Vec3 linear_part(const QuadricCoefficients& a) { return {a[6], a[7], a[8]}; }

/// a x^2 + b x: its largest value (infinite when there is none).
double largest_term(double a, double b) {
  if (a < 0.0) return 0.25 * b * b / -a;
  return a == 0.0 && b == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
}

/// Where a x^2 + b x >= needed; everything when that is not bounded. `slack`: of needed.
Range where_term_reaches(double a, double b, double needed, double slack) {
  constexpr double relative = 16.0 * std::numeric_limits<double>::epsilon();
  if (a < 0.0) {
    const double at = -0.5 * b / a;
    const double square = std::max(0.0, (largest_term(a, b) - needed + slack) / -a);
    const double half = (1.0 + relative) * std::sqrt(square) + relative * std::abs(at);
    return {at - half, at + half};
  }
  if (a > 0.0 || b == 0.0) return Range::everything();
  const double end = (needed - slack) / b, room = relative * std::abs(end);
  return b > 0.0 ? Range{end - room, Range::everything().hi} : Range{Range::everything().lo, end + room};
}

/// Of quadrics without cross terms that are not bounded in every direction: cylinders and slabs along the
/// axes, half-spaces. Each axis is bounded as far as the two others leave it no more than their largest
/// values.
std::optional<Box> separate_region(const QuadricCoefficients& a, double value) {
  if (a[3] != 0.0 || a[4] != 0.0 || a[5] != 0.0) return std::nullopt;
  Box box{Vec3::Constant(Range::everything().lo), Vec3::Constant(Range::everything().hi)};
  const Vec3 square(a[0], a[1], a[2]), line = linear_part(a);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double others = largest_term(square[j], line[j]) + largest_term(square[k], line[k]);
    if (!std::isfinite(others)) continue;
    const double slack = 8.0 * std::numeric_limits<double>::epsilon() *
                         (std::abs(value) + std::abs(a[9]) + others +
                          (square[i] < 0.0 ? largest_term(square[i], line[i]) : 0.0));
    const Range r = where_term_reaches(square[i], line[i], value - a[9] - others, slack);
    box.lo[i] = r.lo;
    box.hi[i] = r.hi;
  }
  if (box.lo.array().isInf().all() && box.hi.array().isInf().all()) return std::nullopt;
  return box;
}

}  // namespace

QuadricCoefficients seen_through(const QuadricCoefficients& a, const Frame& frame) {
  if (frame.identity) return a;
  // Y = M^T X + o: Q = X^T (M S M^T) X + (M (2 S o + b)).X + o^T S o + b.o + A44
  const Eigen::Matrix3d s = quadratic_part(a), m = frame.matrix;
  const Vec3 b = linear_part(a), o = frame.offset;
  const Eigen::Matrix3d square = m * s * m.transpose();
  const Vec3 slope = m * (2.0 * s * o + b);
  return {square(0, 0),       square(1, 1), square(2, 2), 2.0 * square(0, 1), 2.0 * square(0, 2),
          2.0 * square(1, 2), slope[0],     slope[1],     slope[2],           o.dot(s * o) + b.dot(o) + a[9]};
}

std::optional<QuadricTop> top_of(const QuadricCoefficients& a) {
  const Eigen::Matrix3d s = -quadratic_part(a);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(s);
  const Vec3 values = eigen.eigenvalues();
  if (!(values[2] > 0.0) || !(values[0] >= 1e-12 * values[2])) return std::nullopt;
  const Eigen::Matrix3d inverse =
      eigen.eigenvectors() * values.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  QuadricTop top;
  const Vec3 b = linear_part(a);
  top.at = 0.5 * inverse * b;
  top.value = a[9] + 0.5 * b.dot(top.at);
  top.reach = inverse.diagonal().cwiseSqrt();
  top.uncertainty = 64.0 * std::numeric_limits<double>::epsilon() * values[2] / values[0];
  if (!top.at.allFinite() || !top.reach.allFinite() || !std::isfinite(top.value)) return std::nullopt;
  return top;
}

std::optional<Box> quadric_region(const QuadricCoefficients& a, double value) {
  const std::optional<QuadricTop> top = top_of(a);
  if (!top) return separate_region(a, value);
  if (!(value <= top->value)) return Box{top->at, top->at};
  // What rounding can change, relative to the terms that were added up.
  const double e = top->uncertainty;
  const double terms = std::abs(a[9]) + std::abs(linear_part(a).dot(top->at)) + std::abs(value);
  const double height = top->value - value + e * terms;
  const Vec3 half = (1.0 + e) * std::sqrt(height) * top->reach + Vec3::Constant(e * top->at.norm());
  const Box box{top->at - half, top->at + half};
  if (!box.finite()) return std::nullopt;
  return box;
}

}  // namespace blendwright::detail
