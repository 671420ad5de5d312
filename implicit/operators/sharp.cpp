#include "implicit/operators/sharp.hpp"

#include "implicit/number/targets.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/sharp.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const Minimum&, const Inputs<T>& in) {
  return smaller(in.arg(0), in.arg(1));
}
template <class T>
HWY_INLINE T evaluate(const Maximum&, const Inputs<T>& in) {
  return larger(in.arg(0), in.arg(1));
}
template <class T>
HWY_INLINE T evaluate(const Negative&, const Inputs<T>& in) {
  return -in.arg(0);
}
template <class T>
HWY_INLINE T evaluate(const Reciprocal&, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T x = in.arg(0);
  const L v = lane::max(value_of(x), L(negligible)), i = L(1.0) / v;
  return choose<T>(value_of(x) > L(negligible), chain(x, i, -(i * i), L(2.0) * (i * i) * i),
                   T(std::numeric_limits<double>::infinity()));
}
template <class T>
HWY_INLINE T evaluate(const OneMinus&, const Inputs<T>& in) {
  const T f = in.arg(0);
  return chain(f, LaneOf<T>(1.0) - value_of(f), LaneOf<T>(-1.0));
}

KernelSet minimum_simd() { return kernel_set<Minimum, Simd>(); }
KernelSet maximum_simd() { return kernel_set<Maximum, Simd>(); }
KernelSet negative_simd() { return kernel_set<Negative, Simd>(); }
KernelSet reciprocal_simd() { return kernel_set<Reciprocal, Simd>(); }
KernelSet one_minus_simd() { return kernel_set<OneMinus, Simd>(); }
#if HWY_ONCE
KernelSet minimum_scalar() { return kernel_set<Minimum, double>(); }
KernelSet maximum_scalar() { return kernel_set<Maximum, double>(); }
KernelSet negative_scalar() { return kernel_set<Negative, double>(); }
KernelSet reciprocal_scalar() { return kernel_set<Reciprocal, double>(); }
KernelSet one_minus_scalar() { return kernel_set<OneMinus, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "implicit/eval/linear_rules.hpp"
#include "implicit/eval/linear_shapes.hpp"

namespace blendwright {
namespace detail {
HWY_EXPORT(minimum_simd);
HWY_EXPORT(maximum_simd);
HWY_EXPORT(negative_simd);
HWY_EXPORT(reciprocal_simd);
HWY_EXPORT(one_minus_simd);

using Args = std::span<const Range>;

static Range minimum_range(const void*, const Box&, Args args) {
  return {std::min(args[0].lo, args[1].lo), std::min(args[0].hi, args[1].hi)};
}
static Shortcut minimum_shortcut(const void*, const Box&, Args args) {
  if (args[0].hi <= args[1].lo) return Shortcut::to_argument(0);
  return args[1].hi < args[0].lo ? Shortcut::to_argument(1) : Shortcut{};
}
static Range maximum_range(const void*, const Box&, Args args) {
  return {std::max(args[0].lo, args[1].lo), std::max(args[0].hi, args[1].hi)};
}
static Shortcut maximum_shortcut(const void*, const Box&, Args args) {
  if (args[0].lo >= args[1].hi) return Shortcut::to_argument(0);
  return args[1].lo > args[0].hi ? Shortcut::to_argument(1) : Shortcut{};
}

// Division, too, is rounded alike everywhere and monotone. A complement falls.
template <class Body>
Range falling_range(const void* body, const Box&, Args args) {
  const auto at = [&](double x) { return scalar_value(op_for<Body>(), body, Vec3::Zero(), {&x, 1}); };
  return {at(args[0].hi), at(args[0].lo)};
}

/// Convex for x > 0.
static LinearBound reciprocal_bound(const void* body, const LinearInput& in) {
  if (!(in.ranges[0].lo > 2.0 * negligible)) return constant_bound(Range::everything());
  constexpr Curve convex[] = {Curve::convex};
  const auto at = [](const void* b, double x) { return smooth_knot(op_for<Reciprocal>(), b, x); };
  return of_curves(in.args[0], in.ranges[0], {}, convex, at, body, range_slack / in.ranges[0].lo);
}
static LinearBound one_minus_bound(const void*, const LinearInput& in) {
  return constant_bound({1.0, 1.0}) + -1.0 * in.args[0];
}
}  // namespace detail

template <>
const Op& op_for<detail::Minimum>() {
  using namespace detail;
  static const Op op{"min",
                     HWY_DYNAMIC_DISPATCH(minimum_simd)(),
                     HWY_STATIC_DISPATCH(minimum_scalar)(),
                     minimum_range,
                     minimum_shortcut,
                     minimum_bound};
  return op;
}
template <>
const Op& op_for<detail::Maximum>() {
  using namespace detail;
  static const Op op{"max",
                     HWY_DYNAMIC_DISPATCH(maximum_simd)(),
                     HWY_STATIC_DISPATCH(maximum_scalar)(),
                     maximum_range,
                     maximum_shortcut,
                     maximum_bound};
  return op;
}
template <>
const Op& op_for<detail::Negative>() {
  using namespace detail;
  static const Op op{"negative",
                     HWY_DYNAMIC_DISPATCH(negative_simd)(),
                     HWY_STATIC_DISPATCH(negative_scalar)(),
                     falling_range<Negative>,
                     nullptr,
                     negative_bound};
  return op;
}
template <>
const Op& op_for<detail::Reciprocal>() {
  using namespace detail;
  static const Op op{"reciprocal",
                     HWY_DYNAMIC_DISPATCH(reciprocal_simd)(),
                     HWY_STATIC_DISPATCH(reciprocal_scalar)(),
                     falling_range<Reciprocal>,
                     nullptr,
                     reciprocal_bound};
  return op;
}
template <>
const Op& op_for<detail::OneMinus>() {
  using namespace detail;
  static const Op op{"one_minus",
                     HWY_DYNAMIC_DISPATCH(one_minus_simd)(),
                     HWY_STATIC_DISPATCH(one_minus_scalar)(),
                     falling_range<OneMinus>,
                     nullptr,
                     one_minus_bound};
  return op;
}

}  // namespace blendwright
#endif
