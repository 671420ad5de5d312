#include "implicit/primitives/lp_metric.hpp"

#include "implicit/eval/linear_shapes.hpp"
#include "implicit/eval/op.hpp"
#include "implicit/number/targets.hpp"
#include "implicit/primitives/norm_linear.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/primitives/lp_metric.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/number/p_norm-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const LpMetric& b, const Inputs<T>& in) {
  const Point<T> p = in.local();
  const T u[3] = {p.x * b.inverse_axes[0], p.y * b.inverse_axes[1], p.z * b.inverse_axes[2]};
  return p_norm(u, b.n, b.inverse_n);
}

KernelSet lp_metric_simd() { return kernel_set<LpMetric, Simd>(); }
#if HWY_ONCE
KernelSet lp_metric_scalar() { return kernel_set<LpMetric, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(lp_metric_simd);

/// Convex for n >= 1, concave on each octant for n <= 1; elsewhere a norm of a norm.
static LinearBound lp_metric_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const LpMetric*>(body);
  const double n = b.n.exponent;
  const Vec3& f = b.inverse_axes;
  if (n >= 1.0 || in_one_octant(in)) return norm_bound(op_for<LpMetric>(), body, in, n >= 1.0, f);
  const BoundedNumber q =
      norm_of_two(n, coordinate_magnitude(in, 0, f[0]), coordinate_magnitude(in, 1, f[1]));
  return norm_of_two(n, q, coordinate_magnitude(in, 2, f[2])).bound;
}

static Op lp_metric_op() {
  return {"lp_metric",
          HWY_DYNAMIC_DISPATCH(lp_metric_simd)(),
          HWY_STATIC_DISPATCH(lp_metric_scalar)(),
          [](const void* body, const Box& local, std::span<const Range>) {
            return range_by_magnitudes(op_for<LpMetric>(), body, local);
          },
          nullptr,
          lp_metric_linear};
}

}  // namespace detail

template <>
const Op& op_for<detail::LpMetric>() {
  static const Op op = detail::lp_metric_op();
  return op;
}

}  // namespace blendwright
#endif
