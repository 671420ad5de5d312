#include "implicit/operators/potential.hpp"

#include <algorithm>
#include <memory>

#include "implicit/eval/linear_shapes.hpp"
#include "implicit/number/targets.hpp"
#include "implicit/operators/soft_ellipsoid.hpp"
#include "implicit/primitives/lp_metric.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/potential.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// P and its derivatives where d < end, else exactly 0.
template <class T>
HWY_INLINE T within_support(const T& d, double end, LaneOf<T> f, LaneOf<T> f1, LaneOf<T> f2) {
  return choose<T>(value_of(d) < LaneOf<T>(end), chain(d, f, f1, f2), T(0.0));
}

// Both branches are a quotient n^2/D with n = 3 u inside, 1 - u outside. With r = u/D or (1 - u)/D and k = s
// or 2.25 + 3 s (D at the far end, where n = 0 or u = 1): P' = -c d r (1 + k/D), c = 18 or 2. The differences
// are formed as (1 - 2 d)(1 + 2 d) = 1 - 4 u and (1 - d)(1 + d) = 1 - u, exact where they are small.
template <class T>
HWY_INLINE T evaluate(const Blanc& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T x = in.arg(0);
  const L d = lane::max(lane::min(value_of(x), L(2.0)), L(0.0)), u = d * d, s = b.softness;
  const auto inner = d <= L(0.5);
  const L bend = s * ((L(1.0) - (d + d)) * (L(1.0) + (d + d))), rest = (L(1.0) - d) * (L(1.0) + d);
  const L denominator = select(inner, lane::max(bend + L(4.5) * u, L(1e-300)), (L(0.75) + L(1.5) * u) - bend);
  const L inverse = L(1.0) / denominator, r = select(inner, u, rest) * inverse;
  const L quotient = select(inner, L(9.0) * u, rest) * r;
  const L k = select(inner, s, L(2.25) + L(3.0) * s) * inverse;
  const L c = select(inner, L(18.0), L(2.0));
  const L slope = -(c * r) * (L(1.0) + k);  // P'/d
  const L curve = select(inner, L(-72.0) * r, L(8.0) * (u * inverse));
  return within_support(x, 1.0, select(inner, L(1.0) - quotient, quotient), slope * d,
                        slope + curve * (k * k));
}

template <class T>
HWY_INLINE T evaluate(const Wyvill&, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T x = in.arg(0);
  const L d = lane::max(lane::min(value_of(x), L(2.0)), L(0.0)), u = d * d, v = (L(1.0) - d) * (L(1.0) + d),
          ninth = 1.0 / 9.0;
  const L pu = -ninth * (v * (L(22.0) - L(12.0) * u));  // dP/du
  const L puu = ninth * (L(34.0) - L(24.0) * u);
  return within_support(x, 1.0, ninth * ((v * v) * (L(9.0) - L(4.0) * u)), (d + d) * pu,
                        L(2.0) * pu + (L(4.0) * u) * puu);
}

template <class T>
HWY_INLINE T evaluate(const Gaussian&, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T x = in.arg(0);
  const L d = lane::max(lane::min(value_of(x), L(16.0)), L(0.0)), u = d * d,
          k = 2.77258872223978123767;  // 4 ln 2
  const L f = lane::exp(-(k * u)), c = L(2.0) * k * f;
  return within_support(x, 15.0, f, -(c * d), c * (L(2.0) * k * u - L(1.0)));
}

template <class T>
HWY_INLINE T evaluate(const GaussianWindowed&, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T x = in.arg(0);
  const L d = lane::max(lane::min(value_of(x), L(2.0)), L(0.0)), u = d * d, v = (L(1.0) - d) * (L(1.0) + d);
  const L k = 0.47113214262553408;  // 4 ln(9/8)
  const L e = lane::exp(-(k * u)), kv = k * v;
  const L pu = -(e * v) * (L(2.0) + kv), puu = e * (L(2.0) + L(4.0) * kv + kv * kv);
  return within_support(x, 1.0, e * (v * v), (d + d) * pu, L(2.0) * pu + (L(4.0) * u) * puu);
}

KernelSet blanc_simd() { return kernel_set<Blanc, Simd>(); }
KernelSet wyvill_simd() { return kernel_set<Wyvill, Simd>(); }
KernelSet gaussian_simd() { return kernel_set<Gaussian, Simd>(); }
KernelSet gaussian_windowed_simd() { return kernel_set<GaussianWindowed, Simd>(); }
#if HWY_ONCE
KernelSet blanc_scalar() { return kernel_set<Blanc, double>(); }
KernelSet wyvill_scalar() { return kernel_set<Wyvill, double>(); }
KernelSet gaussian_scalar() { return kernel_set<Gaussian, double>(); }
KernelSet gaussian_windowed_scalar() { return kernel_set<GaussianWindowed, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(blanc_simd);
HWY_EXPORT(wyvill_simd);
HWY_EXPORT(gaussian_simd);
HWY_EXPORT(gaussian_windowed_simd);

/// [P(d_hi), P(d_lo)], within [0, 1].
template <class Body>
Range potential_range(const void* body, const Box&, std::span<const Range> args) {
  const Range r = range_by_arguments(op_for<Body>(), body, args, {false});
  return {std::max(0.0, r.lo), std::min(1.0, r.hi)};
}
Shortcut beyond(const Range& d, double end) { return d.lo >= end ? Shortcut::to_constant(0.0) : Shortcut{}; }
Shortcut beyond_one(const void*, const Box&, std::span<const Range> args) { return beyond(args[0], 1.0); }
Shortcut beyond_fifteen(const void*, const Box&, std::span<const Range> args) {
  return beyond(args[0], 15.0);
}

/// Where the potentials turn from concave to convex, and where they end. Those of Wyvill and the windowed
/// Gaussian are zeros of P'': 22 - 102 u + 60 u^2 and (1 - u) (2 + k (1 - u)) - 2 u (2 + 4 k (1 - u) + k^2 (1
/// - u)^2); that of the Gaussian is u = 1/(2 k), k = 4 ln 2. Blanc's inner branch is concave, its outer one
/// convex: (1 - u) (D^2 + k D) < 4 u k^2 for 1/4 <= u <= 1, as the right side is the larger one at u = 1/4
/// and the difference rises with it.
struct Bends {
  static constexpr double blanc[] = {0.5, 1.0};
  static constexpr double wyvill[] = {0.50347028485061292, 1.0};
  static constexpr double gaussian[] = {0.42466090014400952, 15.0};
  static constexpr double gaussian_windowed[] = {0.49952561293904499, 1.0};
};
/// Constant for d < 0, then concave, convex and constant.
template <class Body, auto& Joints>
LinearBound potential_linear(const void* body, const LinearInput& in) {
  constexpr Curve curves[] = {Curve::concave, Curve::convex, Curve::convex};
  const auto at = [](const void* b, double d) { return smooth_knot(op_for<Body>(), b, d); };
  return of_curves(in.args[0], in.ranges[0], Joints, curves, at, body, 4.0 * range_slack);
}

/// Of an ellipsoid: no distance is needed.
Merged soft_ellipsoid_of(const void* body, std::size_t, const Op& inner, const void* inner_body) {
  if (&inner != &op_for<LpMetric>()) return {};
  const auto& metric = *static_cast<const LpMetric*>(inner_body);
  if (metric.n.exponent != 2.0) return {};
  const SoftEllipsoid both{static_cast<const Blanc*>(body)->softness};
  return {&op_for<SoftEllipsoid>(), std::make_shared<const SoftEllipsoid>(both), metric.inverse_axes};
}

}  // namespace detail

template <>
const Op& op_for<detail::Blanc>() {
  using namespace detail;
  static const Op op = [] {
    Op o{"blanc",
         HWY_DYNAMIC_DISPATCH(blanc_simd)(),
         HWY_STATIC_DISPATCH(blanc_scalar)(),
         potential_range<Blanc>,
         beyond_one,
         potential_linear<Blanc, Bends::blanc>};
    o.merge = soft_ellipsoid_of;
    return o;
  }();
  return op;
}
template <>
const Op& op_for<detail::Wyvill>() {
  using namespace detail;
  static const Op op{"wyvill",
                     HWY_DYNAMIC_DISPATCH(wyvill_simd)(),
                     HWY_STATIC_DISPATCH(wyvill_scalar)(),
                     potential_range<Wyvill>,
                     beyond_one,
                     potential_linear<Wyvill, Bends::wyvill>};
  return op;
}
template <>
const Op& op_for<detail::Gaussian>() {
  using namespace detail;
  static const Op op{"gaussian",
                     HWY_DYNAMIC_DISPATCH(gaussian_simd)(),
                     HWY_STATIC_DISPATCH(gaussian_scalar)(),
                     potential_range<Gaussian>,
                     beyond_fifteen,
                     potential_linear<Gaussian, Bends::gaussian>};
  return op;
}
template <>
const Op& op_for<detail::GaussianWindowed>() {
  using namespace detail;
  static const Op op{"gaussian_windowed",
                     HWY_DYNAMIC_DISPATCH(gaussian_windowed_simd)(),
                     HWY_STATIC_DISPATCH(gaussian_windowed_scalar)(),
                     potential_range<GaussianWindowed>,
                     beyond_one,
                     potential_linear<GaussianWindowed, Bends::gaussian_windowed>};
  return op;
}

}  // namespace blendwright
#endif
