#include "implicit/offset/normal_offset.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "implicit/offset/local_points.hpp"

namespace blendwright {
namespace detail {
namespace {

enum class Kernels { simd, scalar };

/// A field's results at all points of a batch.
class Results {
 public:
  Results(const Tape& field, Kernels kernels, Order order, PointArrays points)
      : order_(order), count_(points.size()), data_(components(order) * count_) {
    if (kernels == Kernels::simd)
      field.evaluate(order, points, data_);
    else
      field.evaluate_scalar(order, points, data_);
  }
  [[nodiscard]] PointJet operator[](std::size_t i) const { return jet_of(data_.data(), order_, count_, i); }

 private:
  Order order_;
  std::size_t count_;
  std::vector<double> data_;
};

bool has_direction(const Vec3& g) {
  const double size = g.stableNorm();
  return size > least_gradient && std::isfinite(size);
}

/// The points moved along a direction each, by `length`.
struct MovedPoints {
  std::vector<double> x, y, z;
  MovedPoints(const LocalPoints& points, const std::vector<Vec3>& directions, double length) {
    for (std::size_t i = 0; i < points.count; ++i) {
      const Vec3 p = points.at(i) + length * directions[i];
      x.push_back(p.x());
      y.push_back(p.y());
      z.push_back(p.z());
    }
  }
  [[nodiscard]] PointArrays arrays() const { return {x, y, z}; }
};

/// (I - N N^T) g(Y) D/|g|: the direction along which H changes in the derivatives of (2).
Vec3 turning(const PointJet& here, const PointJet& there, double distance) {
  const double size = here.gradient.norm();
  const Vec3 n = here.gradient / size;
  return (distance / size) * (there.gradient - n * n.dot(there.gradient));
}

/// Derivatives of H along unit directions (zero vectors: none), times `rates`.
std::vector<Eigen::Matrix3d> changes(const NormalOffset& b, Kernels kernels, const LocalPoints& points,
                                     const std::vector<Vec3>& directions, const std::vector<double>& rates) {
  constexpr double steps[] = {-2.0, -1.0, 1.0, 2.0}, weights[] = {1.0, -8.0, 8.0, -1.0};
  const double h = 1e-3 * std::abs(b.distance);
  std::vector<Eigen::Matrix3d> sum(points.count, Eigen::Matrix3d::Zero());
  for (std::size_t k = 0; k < 4; ++k) {
    const MovedPoints moved(points, directions, steps[k] * h);
    const Results f(*b.field, kernels, Order::hessian, moved.arrays());
    for (std::size_t i = 0; i < points.count; ++i)
      sum[i] += (weights[k] * rates[i] / (12.0 * h)) * f[i].hessian;
  }
  return sum;
}

/// Second derivatives of (1): with J = I + (D/|g|) (I - N N^T) H,
///   J^T H(Y) J + H P H + change, P the second derivatives of D g(Y).p/|p| by p at p = g.
Eigen::Matrix3d second_derivatives(const PointJet& here, const PointJet& there, double distance,
                                   const Eigen::Matrix3d& change) {
  const double size = here.gradient.norm();
  const Vec3 n = here.gradient / size, c = there.gradient;
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - n * n.transpose();
  const Eigen::Matrix3d J = Eigen::Matrix3d::Identity() + (distance / size) * across * here.hessian;
  const Vec3 part = across * c;
  const Eigen::Matrix3d P =
      (-distance / (size * size)) * (n * part.transpose() + part * n.transpose() + n.dot(c) * across);
  return J.transpose() * there.hessian * J + here.hessian * P * here.hessian + change;
}

void add_second_derivatives(const NormalOffset& b, Kernels kernels, const LocalPoints& points,
                            const Results& here, const Results& there, std::vector<PointJet>& f) {
  std::vector<Vec3> directions(points.count, Vec3::Zero());
  std::vector<double> rates(points.count, 0.0);
  for (std::size_t i = 0; i < points.count; ++i) {
    if (!has_direction(here[i].gradient)) continue;
    const Vec3 w = turning(here[i], there[i], b.distance);
    const double rate = w.stableNorm();
    if (!(rate > 0.0) || !std::isfinite(rate)) continue;
    directions[i] = w / rate;
    rates[i] = rate;
  }
  const std::vector<Eigen::Matrix3d> change = changes(b, kernels, points, directions, rates);
  for (std::size_t i = 0; i < points.count; ++i) {
    if (!has_direction(here[i].gradient)) continue;
    f[i].hessian = second_derivatives(here[i], there[i], b.distance, change[i]);
    if (!f[i].hessian.allFinite()) f[i].hessian.setZero();
  }
}

template <Kernels kernels, Order order>
void run(const void* body, const KernelInput& in, double* out) {
  const auto& b = *static_cast<const NormalOffset*>(body);
  const LocalPoints points(in);
  constexpr Order order_here = order == Order::value ? Order::gradient : Order::hessian;
  const Results here(*b.field, kernels, order_here, points.arrays());
  std::vector<Vec3> normals(points.count, Vec3::Zero());
  for (std::size_t i = 0; i < points.count; ++i)
    if (const Vec3 g = here[i].gradient; has_direction(g)) normals[i] = g / g.stableNorm();
  const MovedPoints probes(points, normals, b.distance);
  const Results there(*b.field, kernels, order, probes.arrays());
  std::vector<PointJet> f(points.count);
  for (std::size_t i = 0; i < points.count; ++i) {
    f[i] = there[i];
    if (order == Order::value || !has_direction(here[i].gradient)) continue;
    f[i].gradient += here[i].hessian * turning(here[i], there[i], b.distance);
    if (!f[i].gradient.allFinite()) f[i].gradient.setZero();
  }
  if (order == Order::hessian) add_second_derivatives(b, kernels, points, here, there, f);
  for (std::size_t i = 0; i < points.count; ++i) store(f[i], order, in, i, out);
}

template <Kernels kernels>
KernelSet kernel_set() {
  return {{run<kernels, Order::value>, run<kernels, Order::gradient>, run<kernels, Order::hessian>}};
}

/// The probe stays within |D|.
Range normal_offset_range(const void* body, const Box& local, std::span<const Range>) {
  const auto& b = *static_cast<const NormalOffset*>(body);
  return range_around(*b.field, local, std::abs(b.distance));
}

}  // namespace
}  // namespace detail

template <>
const Op& op_for<detail::NormalOffset>() {
  using namespace detail;
  static const Op op{"normal_offset", kernel_set<Kernels::simd>(), kernel_set<Kernels::scalar>(),
                     normal_offset_range};
  return op;
}

}  // namespace blendwright
