#include "implicit/offset/local_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blendwright::detail {

LocalPoints::LocalPoints(const KernelInput& in) : count(in.count) {
  if (in.frame == nullptr) {
    std::copy_n(in.x, count, x);
    std::copy_n(in.y, count, y);
    std::copy_n(in.z, count, z);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 local = in.frame->local({in.x[i], in.y[i], in.z[i]});
    x[i] = local.x();
    y[i] = local.y();
    z[i] = local.z();
  }
}

void store(const PointJet& f, Order order, const KernelInput& in, std::size_t i, double* out) {
  out[i] = f.value;
  if (order == Order::value) return;
  const Vec3 g = in.frame ? Vec3(in.frame->matrix * f.gradient) : f.gradient;
  for (std::size_t c = 0; c < 3; ++c) out[(1 + c) * batch_size + i] = g[static_cast<Eigen::Index>(c)];
  if (order == Order::gradient) return;
  Eigen::Matrix3d h = f.hessian;
  if (in.frame) h = in.frame->matrix * f.hessian * in.frame->matrix.transpose();
  const double parts[] = {h(0, 0), h(1, 1), h(2, 2), h(0, 1), h(0, 2), h(1, 2)};
  for (std::size_t c = 0; c < 6; ++c) out[(4 + c) * batch_size + i] = parts[c];
}

PointJet jet_of(const double* results, Order order, std::size_t count, std::size_t i) {
  PointJet f;
  f.value = results[i];
  if (order == Order::value) return f;
  const auto part = [&](std::size_t c) { return results[c * count + i]; };
  f.gradient = {part(1), part(2), part(3)};
  if (order == Order::gradient) return f;
  f.hessian << part(4), part(7), part(8), part(7), part(5), part(9), part(8), part(9), part(6);
  return f;
}

PointJet jet_at(const ScalarField::Model& field, Order order, const Vec3& at) {
  double results[components(Order::hessian)];
  field.evaluate(order, {{&at.x(), 1}, {&at.y(), 1}, {&at.z(), 1}}, {results, components(order)});
  return jet_of(results, order, 1, 0);
}

Box inflated(const Box& box, double length) {
  constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();
  const Vec3 more =
      (length * (1.0 + rounding) + rounding * box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs()).array());
  return {box.lo - more, box.hi + more};
}

Range range_around(const ScalarField::Model& field, const Box& box, double radius) {
  const Box around = inflated(box, radius);
  Range range = field.range(around);
  if (!around.finite() || !std::isfinite(range.lo) || !std::isfinite(range.hi)) return range;
  // f(Y) = value + q.(Y - c) + rest, and q.(Y - X) is at most |q| radius.
  const LinearBound f = field.linear(around);
  const Vec3 half = 0.5 * around.size(), q = f.slope.cwiseQuotient(half);
  const double reach = q.cwiseAbs().dot(half - Vec3::Constant(radius)) + q.norm() * radius;
  const double slack = 1e-14 * (std::abs(f.value) + f.slope.lpNorm<1>());
  range.lo = std::max(range.lo, f.value - reach + f.rest.lo - slack);
  range.hi = std::min(range.hi, f.value + reach + f.rest.hi + slack);
  return range;
}

}  // namespace blendwright::detail
