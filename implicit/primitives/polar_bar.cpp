#include "implicit/primitives/polar_bar.hpp"

#include <cmath>

#include "implicit/eval/linear_rules.hpp"
#include "implicit/eval/linear_shapes.hpp"
#include "implicit/number/targets.hpp"
#include "implicit/primitives/norm_linear.hpp"
#include "implicit/primitives/profile_linear.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/primitives/polar_bar.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/primitives/profile-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const PolarBar& b, const Inputs<T>& in) {
  const Point<T> p = in.local();
  const T u[2] = {gauge(b.profile, p.x, p.y), p.z * b.inverse_c};
  return p_norm(u, b.n, b.inverse_n);
}

KernelSet polar_bar_simd() { return kernel_set<PolarBar, Simd>(); }
#if HWY_ONCE
KernelSet polar_bar_scalar() { return kernel_set<PolarBar, double>(); }
static double polar_bar_norm(const PolarBar& b, double g, double w) {
  const double u[2] = {g, w};
  return p_norm(u, b.n, b.inverse_n);
}
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(polar_bar_simd);

// (1) rises with g and |z|: end points.
static Range polar_bar_range(const void* body, const Box& local, std::span<const Range>) {
  const PolarBar& b = *static_cast<const PolarBar*>(body);
  const Range g = gauge_range(b.profile, plane_box(local.axis(0), local.axis(1)));
  const Range w = magnitude(local.axis(2));
  return Range{HWY_STATIC_DISPATCH(polar_bar_norm)(b, g.lo, w.lo * b.inverse_c),
               HWY_STATIC_DISPATCH(polar_bar_norm)(b, g.hi, w.hi * b.inverse_c)}
      .widened(range_slack);
}

/// Convex with a convex profile; else the norm of what is known of g and of |z/c|.
static LinearBound polar_bar_linear(const void* body, const LinearInput& in) {
  const PolarBar& b = *static_cast<const PolarBar*>(body);
  const Profile& p = b.profile;
  if (p.kind == Profile::Kind::lp && p.n.exponent >= 1.0)
    return gauge_bound(op_for<PolarBar>(), body, in, Curve::convex, {1.0 / p.a, 1.0 / p.b, b.inverse_c});
  return norm_of_two(b.n.exponent, gauge_linear(p, in), coordinate_magnitude(in, 2, b.inverse_c)).bound;
}

static Op polar_bar_op() {
  return {"polar_bar",
          HWY_DYNAMIC_DISPATCH(polar_bar_simd)(),
          HWY_STATIC_DISPATCH(polar_bar_scalar)(),
          polar_bar_range,
          nullptr,
          polar_bar_linear};
}

}  // namespace detail

template <>
const Op& op_for<detail::PolarBar>() {
  static const Op op = detail::polar_bar_op();
  return op;
}

}  // namespace blendwright
#endif
