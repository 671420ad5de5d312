#include "implicit/offset/polyhedron.hpp"

#include <algorithm>
#include <cmath>

#include "implicit/offset/local_points.hpp"

namespace blendwright {
namespace detail {
namespace {

constexpr double least_determinant = 1e-10;  // of products of unit normals: nearly parallel planes have none

/// The step from x to the common points of up to three planes, which all lie on its far side.
struct Step {
  Vec3 to = Vec3::Zero();
  int planes = 0;
  Eigen::Matrix3d across = Eigen::Matrix3d::Zero();  ///< onto the span of the normals
};

/// depth_i = -(n_i.x + c_i).
class Steps {
 public:
  Steps(const std::vector<HalfSpace>& planes, const std::vector<double>& depth)
      : planes_(planes), depth_(depth) {}

  void add(std::size_t i) {
    if (depth_[i] > 0.0) take(depth_[i] * normal(i), 1, normal(i) * normal(i).transpose());
  }
  void add(std::size_t i, std::size_t j) {
    const double c = normal(i).dot(normal(j)), det = 1.0 - c * c;
    if (!(det > least_determinant)) return;
    const double li = (depth_[i] - c * depth_[j]) / det, lj = (depth_[j] - c * depth_[i]) / det;
    if (!(li >= 0.0 && lj >= 0.0)) return;
    const Vec3 edge = normal(i).cross(normal(j)).normalized();
    take(li * normal(i) + lj * normal(j), 2, Eigen::Matrix3d::Identity() - edge * edge.transpose());
  }
  void add(std::size_t i, std::size_t j, std::size_t k) {
    Eigen::Matrix3d n;
    n << normal(i), normal(j), normal(k);
    const double det = n.determinant();
    if (!(det * det > least_determinant)) return;
    const Vec3 to = n.transpose().inverse() * Vec3(depth_[i], depth_[j], depth_[k]);
    const Vec3 l = n.inverse() * to;
    if (l.minCoeff() >= 0.0) take(to, 3, Eigen::Matrix3d::Identity());
  }
  [[nodiscard]] const Step& longest() const { return best_; }

 private:
  [[nodiscard]] const Vec3& normal(std::size_t i) const { return planes_[i].normal; }
  /// Fewer planes win ties: their second derivatives are those of the region.
  void take(const Vec3& to, int planes, const Eigen::Matrix3d& across) {
    if (to.norm() > best_.to.norm() * (1.0 + 1e-14)) best_ = {to, planes, across};
  }
  const std::vector<HalfSpace>& planes_;
  const std::vector<double>& depth_;
  Step best_;
};

Step step_to(const std::vector<HalfSpace>& planes, const std::vector<double>& depth) {
  Steps steps(planes, depth);
  const std::size_t n = planes.size();
  for (std::size_t i = 0; i < n; ++i) steps.add(i);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) steps.add(i, j);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k) steps.add(i, j, k);
  return steps.longest();
}

std::vector<double> depths(const std::vector<HalfSpace>& planes, const Vec3& x) {
  std::vector<double> depth;
  for (const HalfSpace& p : planes) depth.push_back(-(p.normal.dot(x) + p.offset));
  return depth;
}

}  // namespace

PolyhedronPoint polyhedron_point(const std::vector<HalfSpace>& planes, const Vec3& x) {
  const std::vector<double> depth = depths(planes, x);
  const auto deepest = std::max_element(depth.begin(), depth.end());
  const HalfSpace& nearest = planes[static_cast<std::size_t>(deepest - depth.begin())];
  if (!(*deepest > 0.0)) return {-*deepest, nearest.normal, Eigen::Matrix3d::Zero()};
  const Step step = step_to(planes, depth);
  const double distance = step.to.norm();
  if (!(distance > 0.0) || !std::isfinite(distance))
    return {-*deepest, nearest.normal, Eigen::Matrix3d::Zero()};
  const Vec3 u = step.to / distance;
  PolyhedronPoint p{-distance, u, Eigen::Matrix3d::Zero()};
  if (step.planes > 1 && distance > 1e-60) p.hessian = (u * u.transpose() - step.across) / distance;
  return p;
}

bool empty(const std::vector<HalfSpace>& planes) {
  double size = 0.0;
  for (const HalfSpace& p : planes) size = std::max(size, std::abs(p.offset));
  const std::vector<double> depth = depths(planes, Vec3::Zero());
  const std::vector<double> left = depths(planes, step_to(planes, depth).to);
  return *std::max_element(left.begin(), left.end()) > 1e-9 * size;
}

namespace {

template <Order order>
void run(const void* body, const KernelInput& in, double* out) {
  const auto& b = *static_cast<const PolyhedronDistance*>(body);
  const LocalPoints points(in);
  for (std::size_t i = 0; i < points.count; ++i) {
    const PolyhedronPoint p = polyhedron_point(b.planes, points.at(i));
    store({b.sign * p.distance + b.shift, b.sign * p.gradient, b.sign * p.hessian}, order, in, i, out);
  }
}

/// d is concave: the least value is in a corner; and no distance changes faster than the point.
Range polyhedron_range(const void* body, const Box& local, std::span<const Range>) {
  if (!local.finite()) return Range::everything();
  const auto& b = *static_cast<const PolyhedronDistance*>(body);
  const Vec3 c = local.centre(), h = 0.5 * local.size();
  double least = std::numeric_limits<double>::infinity(), most = least, size = 0.0;
  for (unsigned k = 0; k < 8; ++k) {
    const Vec3 corner = c + Vec3(k & 1 ? h.x() : -h.x(), k & 2 ? h.y() : -h.y(), k & 4 ? h.z() : -h.z());
    least = std::min(least, polyhedron_point(b.planes, corner).distance);
  }
  for (const HalfSpace& p : b.planes) {
    most = std::min(most, p.normal.dot(c) + p.offset + p.normal.cwiseAbs().dot(h));
    size = std::max(size, std::abs(p.offset));
  }
  most = std::min(most, polyhedron_point(b.planes, c).distance + h.norm());
  const double slack = 1e-13 * (size + c.norm() + h.norm() + std::abs(b.shift));
  const Range d{least - slack, most + slack};
  return b.sign > 0.0 ? Range{d.lo + b.shift, d.hi + b.shift} : Range{b.shift - d.hi, b.shift - d.lo};
}

}  // namespace
}  // namespace detail

template <>
const Op& op_for<detail::PolyhedronDistance>() {
  using namespace detail;
  static constexpr KernelSet kernels{{run<Order::value>, run<Order::gradient>, run<Order::hessian>}};
  static const Op op{"polyhedron_distance", kernels, kernels, polyhedron_range};
  return op;
}

}  // namespace blendwright
