#include "implicit/primitives/generalized_distance.hpp"

#include "implicit/eval/linear_shapes.hpp"
#include "implicit/eval/op.hpp"
#include "implicit/number/targets.hpp"
#include "implicit/primitives/plane.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/primitives/generalized_distance.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/number/p_norm-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// y_i = X.n_i; norms take magnitudes.
template <class T>
struct FacetTerms {
  const std::vector<Vec3>& normals;
  const Point<T>& p;
  HWY_INLINE T operator()(std::size_t i) const {
    const Vec3& n = normals[i];
    return p.x * n[0] + p.y * n[1] + p.z * n[2];
  }
};

template <class T>
HWY_INLINE T evaluate(const GeneralizedDistance& b, const Inputs<T>& in) {
  const Point<T> p = in.local();
  return p_norm_of<T>(FacetTerms<T>{b.normals, p}, b.normals.size(), b.n, b.inverse_n);
}

KernelSet generalized_simd() { return kernel_set<GeneralizedDistance, Simd>(); }
#if HWY_ONCE
KernelSet generalized_scalar() { return kernel_set<GeneralizedDistance, double>(); }

/// The smallest |y_i| over a box.
struct SmallestTerms {
  const std::vector<Vec3>& normals;
  const Box& box;
  double operator()(std::size_t i) const { return magnitude(linear_range(normals[i], box)).lo; }
};
double smallest_norm(const GeneralizedDistance& b, const Box& box) {
  return p_norm_of<double>(SmallestTerms{b.normals, box}, b.normals.size(), b.n, b.inverse_n);
}
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(generalized_simd);

/// d is convex and ray-linear, so d(X) >= g.X for its gradient g anywhere (Euler: d(c) = g.c).
static double tangent_bound(const void* body, const Box& box) {
  const Vec3 c = box.centre();
  const KernelInput in{&c.x(), &c.y(), &c.z(), nullptr, nullptr, 0, 1};
  double out[4 * batch_size];
  op_for<GeneralizedDistance>().scalar.run[1](body, in, out);
  const Vec3 g(out[batch_size], out[2 * batch_size], out[3 * batch_size]);
  const double size = g.cwiseAbs().dot(box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs()));
  return linear_range(g, box).lo - range_slack * size;
}

static Range generalized_range(const void* body, const Box& local, std::span<const Range>) {
  const auto& b = *static_cast<const GeneralizedDistance*>(body);
  const Op& op = op_for<GeneralizedDistance>();
  Range r{HWY_STATIC_DISPATCH(smallest_norm)(b, local), 0.0};
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3 corner((i & 1) ? local.hi.x() : local.lo.x(), (i & 2) ? local.hi.y() : local.lo.y(),
                      (i & 4) ? local.hi.z() : local.lo.z());
    r.hi = std::max(r.hi, scalar_value(op, body, corner));
  }
  r = r.widened(range_slack);
  if (local.finite()) r.lo = std::max(r.lo, tangent_bound(body, local));
  // A small d that is left of large terms has their rounding.
  const double size = local.lo.cwiseAbs().cwiseMax(local.hi.cwiseAbs()).sum();
  const double slack = 6.0 * std::numeric_limits<double>::epsilon() * size *
                       std::pow(static_cast<double>(b.normals.size()), b.inverse_n.exponent);
  return {std::max(0.0, r.lo - slack), r.hi + slack};
}

/// Convex; every term has a partial of at most 1 and the rounding of coordinates.
static LinearBound generalized_linear(const void* body, const LinearInput& in) {
  const auto count = static_cast<double>(static_cast<const GeneralizedDistance*>(body)->normals.size());
  return gauge_bound(op_for<GeneralizedDistance>(), body, in, Curve::convex, Vec3::Constant(count));
}

bool span_space(const std::vector<Vec3>& normals) {
  const Vec3 a = normals.front();
  Vec3 across = Vec3::Zero();
  for (const Vec3& n : normals)
    if (const Vec3 c = a.cross(n); c.norm() > across.norm()) across = c;
  if (across.norm() <= 1e-6) return false;
  across.normalize();
  return std::any_of(normals.begin(), normals.end(),
                     [&](const Vec3& n) { return std::abs(n.dot(across)) > 1e-6; });
}

/// N_m, m >= 1, of weights of any sign; m = inf: the largest magnitude.
static double dual_norm(const std::vector<double>& w, double m) {
  double largest = 0.0, sum = 0.0;
  for (const double x : w) largest = std::max(largest, std::abs(x));
  if (largest == 0.0 || !std::isfinite(m)) return largest;
  for (const double x : w) sum += std::pow(std::abs(x) / largest, m);
  return largest * std::pow(sum, 1.0 / m);
}

namespace {
/// Weights w_i with sum w_i n_i = e, but for what is left over.
struct Combination {
  std::vector<double> weights;
  Vec3 rest;
};
}  // namespace

/// The combination that minimises sum w_i^2 / s_i.
static Combination combine(const std::vector<Vec3>& normals, const std::vector<double>& s, const Vec3& e) {
  Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < normals.size(); ++i) gram += s[i] * normals[i] * normals[i].transpose();
  const Eigen::Matrix3d inverse = gram.inverse();
  Combination c{std::vector<double>(normals.size(), 0.0), e};
  for (int pass = 0; pass < 3; ++pass) {  // the second and third take off what rounding left
    const Vec3 step = inverse * c.rest;
    c.rest = e;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      c.weights[i] += s[i] * normals[i].dot(step);
      c.rest -= c.weights[i] * normals[i];
    }
  }
  return c;
}

/// If sum w_i n_i = e_j then x_j = sum w_i y_i <= N_m(w) N_n(y), 1/m + 1/n = 1 (Hoelder): every such
/// combination bounds |x_j| on d <= 1 by N_m(w). The least one is approached by reweighted least squares; its
/// result need not be the least to be a bound. What is left over of e_j counts with the size of the box.
Vec3 half_size(const GeneralizedDistance& b) {
  const double m =
      b.n.exponent > 1.0 ? b.n.exponent / (b.n.exponent - 1.0) : std::numeric_limits<double>::infinity();
  const std::size_t k = b.normals.size();
  Vec3 bound = Vec3::Constant(std::numeric_limits<double>::infinity()), rest = Vec3::Zero();
  for (int j = 0; j < 3; ++j) {
    std::vector<double> s(k, 1.0);
    for (int pass = 0; pass < 60; ++pass) {
      const Combination c = combine(b.normals, s, Vec3::Unit(j));
      const double left = c.rest.lpNorm<1>(), size = dual_norm(c.weights, m);
      if (!(left < 0.1) || !std::isfinite(size)) break;
      if (size < bound[j]) {
        bound[j] = size;
        rest[j] = left;
      }
      const double floor = 1e-6 * dual_norm(c.weights, std::numeric_limits<double>::infinity());
      for (std::size_t i = 0; i < k; ++i)
        s[i] = std::pow(std::hypot(c.weights[i], floor), std::max(2.0 - m, -0.5));
    }
  }
  const double largest = bound.maxCoeff() / (1.0 - rest.maxCoeff());
  return (bound + rest * largest) * (1.0 + 1e-12);
}

}  // namespace detail

template <>
const Op& op_for<detail::GeneralizedDistance>() {
  using namespace detail;
  static const Op op{"generalized_distance",
                     HWY_DYNAMIC_DISPATCH(generalized_simd)(),
                     HWY_STATIC_DISPATCH(generalized_scalar)(),
                     generalized_range,
                     nullptr,
                     generalized_linear};
  return op;
}

}  // namespace blendwright
#endif
