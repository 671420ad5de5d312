#pragma once
// What kernels share that are written point by point, without vectors: coordinates in, results out.
#include "implicit/eval/op.hpp"

namespace blendwright::detail {

/// The local coordinates of a batch.
struct LocalPoints {
  explicit LocalPoints(const KernelInput& in);
  double x[batch_size], y[batch_size], z[batch_size];
  std::size_t count;
  [[nodiscard]] Vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
  [[nodiscard]] PointArrays arrays() const { return {{x, count}, {y, count}, {z, count}}; }
};

/// A value with its derivatives by local coordinates.
struct PointJet {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};
/// Writes the result of point i, with derivatives by the scene's coordinates.
void store(const PointJet& f, Order order, const KernelInput& in, std::size_t i, double* out);

/// The field's values and derivatives at one point. Numbers that are not finite count as 0 in derivatives.
[[nodiscard]] PointJet jet_at(const ScalarField::Model& field, Order order, const Vec3& at);
/// The same of point i of a batch of results.
[[nodiscard]] PointJet jet_of(const double* results, Order order, std::size_t count, std::size_t i);

/// The box moved out by `length` in every direction, with what rounding can add.
[[nodiscard]] Box inflated(const Box& box, double length);
/// Contains f(Y) for all |Y - X| <= radius, X in the box; not wider than the range over the inflated box.
[[nodiscard]] Range range_around(const ScalarField::Model& field, const Box& box, double radius);

}  // namespace blendwright::detail
