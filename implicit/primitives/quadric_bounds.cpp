#include <cmath>
#include <limits>

#include "implicit/primitives/quadric.hpp"

namespace blendwright::detail {
namespace {

/// Symmetric 3x3 entry (i, j) of the doubled quadratic part: the Hessian.
double hessian_entry(const QuadricCoefficients& a, int i, int j) {
  if (i == j) return 2.0 * a[static_cast<std::size_t>(i)];
  const int sum = i + j;  // 01: 1, 02: 2, 12: 3
  return a[static_cast<std::size_t>(2 + sum)];
}

double value_at(const QuadricCoefficients& a, const Vec3& t) {
  return t.x() * (a[0] * t.x() + a[3] * t.y() + a[4] * t.z() + a[6]) +
         t.y() * (a[1] * t.y() + a[5] * t.z() + a[7]) + t.z() * (a[2] * t.z() + a[8]) + a[9];
}

/// Adds what the quadric takes at the stationary point of the sub-face where the coordinates outside `free`
/// are fixed, if that point lies in it. A singular sub-system has its extremes on a smaller sub-face.
void add_stationary(const QuadricCoefficients& a, Vec3 t, std::array<int, 3> free, int count, Range& range) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
  Vec3 b = Vec3::Zero();
  for (int r = 0; r < count; ++r) {
    const int i = free[static_cast<std::size_t>(r)];
    b[r] = -a[static_cast<std::size_t>(6 + i)];
    for (int j = 0; j < 3; ++j) b[r] -= hessian_entry(a, i, j) * t[j];  // free coordinates of t are 0
    for (int c = 0; c < count; ++c) m(r, c) = hessian_entry(a, i, free[static_cast<std::size_t>(c)]);
  }
  double scale = 1.0;
  for (int r = 0; r < count; ++r) scale *= m.row(r).head(count).norm();
  const double det = m.determinant();
  if (!(std::abs(det) > 1e-14 * scale)) return;
  const Vec3 s = m.inverse() * b;
  for (int r = 0; r < count; ++r) {
    if (!(std::abs(s[r]) <= 1.0)) return;
    t[free[static_cast<std::size_t>(r)]] = s[r];
  }
  const double q = value_at(a, t);
  range.lo = std::min(range.lo, q);
  range.hi = std::max(range.hi, q);
}

}  // namespace

QuadricCoefficients remapped(const QuadricCoefficients& a, const Vec3& c, const Vec3& h) {
  QuadricCoefficients r{};
  for (int i = 0; i < 3; ++i) {
    double slope = a[static_cast<std::size_t>(6 + i)];
    for (int j = 0; j < 3; ++j) slope += hessian_entry(a, i, j) * c[j];
    r[static_cast<std::size_t>(i)] = a[static_cast<std::size_t>(i)] * h[i] * h[i];
    r[static_cast<std::size_t>(6 + i)] = h[i] * slope;
  }
  r[3] = a[3] * h[0] * h[1];
  r[4] = a[4] * h[0] * h[2];
  r[5] = a[5] * h[1] * h[2];
  r[9] = value_at(a, c);
  return r;
}

Range sum_bound(const QuadricCoefficients& a) {
  double m = 0.0;
  for (std::size_t i = 0; i < 9; ++i) m += std::abs(a[i]);
  return {a[9] - m, a[9] + m};
}

Range tight_bound(const QuadricCoefficients& a) {
  const double cross = std::abs(a[3]) + std::abs(a[4]) + std::abs(a[5]);
  Range r{a[9] - cross, a[9] + cross};
  for (std::size_t i = 0; i < 3; ++i) {
    const double square = a[i], slope = a[6 + i];
    double lo = square - std::abs(slope), hi = square + std::abs(slope);
    if (square != 0.0 && std::abs(slope) < 2.0 * std::abs(square)) {
      const double inner = -slope * slope / (4.0 * square);
      lo = std::min(lo, inner);
      hi = std::max(hi, inner);
    }
    r.lo += lo;
    r.hi += hi;
  }
  return r;
}

Range exact_range(const QuadricCoefficients& a) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (int face = 0; face < 27; ++face) {  // each coordinate: fixed at -1, fixed at +1, free
    const int state[3] = {face % 3, face / 3 % 3, face / 9};
    Vec3 t = Vec3::Zero();
    std::array<int, 3> free{};
    int count = 0;
    for (int i = 0; i < 3; ++i) {
      if (state[i] == 2)
        free[static_cast<std::size_t>(count++)] = i;
      else
        t[i] = state[i] == 0 ? -1.0 : 1.0;
    }
    if (count == 0) {
      const double q = value_at(a, t);
      range.lo = std::min(range.lo, q);
      range.hi = std::max(range.hi, q);
    } else {
      add_stationary(a, t, free, count, range);
    }
  }
  return range;
}

Range quadric_range(const QuadricCoefficients& a, const Box& box) {
  if (!box.finite()) return Range::everything();
  const Vec3 c = box.centre(), h = 0.5 * box.size();
  const Range r = tight_bound(remapped(a, c, h));
  // |A44'| of the remapped quadric is no scale for its rounding: it is a difference of terms of this size.
  QuadricCoefficients magnitudes{};
  for (std::size_t i = 0; i < 10; ++i) magnitudes[i] = std::abs(a[i]);
  const double slack = 32.0 * std::numeric_limits<double>::epsilon() * value_at(magnitudes, c.cwiseAbs() + h);
  const Range range{r.lo - slack, r.hi + slack};
  return std::isfinite(range.lo) && std::isfinite(range.hi) ? range : Range::everything();
}

}  // namespace blendwright::detail
