#include "kernel/field/scalar_field.hpp"

namespace blendwright {

FieldValues ScalarField::evaluate(Order order, PointArrays points) const {
  FieldValues result{order, points.size(), std::vector<double>(components(order) * points.size())};
  model_->evaluate(order, points, result.data);
  return result;
}

FieldValues ScalarField::evaluate(Order order, std::span<const Vec3> points) const {
  std::vector<double> xyz(3 * points.size());
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k) xyz[k * n + i] = points[i][static_cast<Eigen::Index>(k)];
  const std::span<const double> all(xyz);
  return evaluate(order, PointArrays{all.subspan(0, n), all.subspan(n, n), all.subspan(2 * n, n)});
}

double ScalarField::value(const Vec3& point) const {
  return evaluate(Order::value, std::span<const Vec3>(&point, 1)).value(0);
}

std::optional<LevelCurvature> level_curvature(const Vec3& g, const std::array<double, 6>& h, Level level) {
  const double length = g.norm();
  if (!(length > 0.0)) return std::nullopt;
  const Vec3 n = g / length;
  const auto [xx, yy, zz, xy, xz, yz] = h;
  const double nHn = n.x() * n.x() * xx + n.y() * n.y() * yy + n.z() * n.z() * zz +
                     2.0 * (n.x() * n.y() * xy + n.x() * n.z() * xz + n.y() * n.z() * yz);
  const double nAn = n.x() * n.x() * (yy * zz - yz * yz) + n.y() * n.y() * (xx * zz - xz * xz) +
                     n.z() * n.z() * (xx * yy - xy * xy) +
                     2.0 * (n.x() * n.y() * (xz * yz - xy * zz) + n.x() * n.z() * (xy * yz - xz * yy) +
                            n.y() * n.z() * (xy * xz - xx * yz));
  const LevelCurvature k{-sense(level) * (xx + yy + zz - nHn) / (2.0 * length), nAn / (length * length)};
  if (!std::isfinite(k.mean) || !std::isfinite(k.gaussian)) return std::nullopt;
  return k;
}

}  // namespace blendwright
