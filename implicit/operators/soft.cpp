#include "implicit/operators/soft.hpp"

#include "implicit/eval/linear_rules.hpp"
#include "implicit/eval/linear_shapes.hpp"
#include "implicit/number/targets.hpp"
#include "implicit/operators/range_rules.hpp"
#include "implicit/operators/soft_ellipsoid.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/soft.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const SoftSum&, const Inputs<T>& in) {
  return in.arg(0) + in.arg(1);
}

template <class T>
HWY_INLINE T evaluate(const SoftOverlap& b, const Inputs<T>& in) {
  const T f = in.arg(0);
  return choose<T>(value_of(f) > LaneOf<T>(b.offset), f - T(b.offset), T(0.0));
}

template <class T>
HWY_INLINE T evaluate(const SoftDifference&, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T a = in.arg(0), b = in.arg(1);
  const T rest = choose<T>(value_of(a) > value_of(b), a - b, T(0.0));
  return choose<T>(value_of(b) == L(0.0) && value_of(a) >= L(0.0), a, rest);
}

KernelSet soft_sum_simd() { return kernel_set<SoftSum, Simd>(); }
KernelSet soft_overlap_simd() { return kernel_set<SoftOverlap, Simd>(); }
KernelSet soft_difference_simd() { return kernel_set<SoftDifference, Simd>(); }
#if HWY_ONCE
KernelSet soft_sum_scalar() { return kernel_set<SoftSum, double>(); }
KernelSet soft_overlap_scalar() { return kernel_set<SoftOverlap, double>(); }
KernelSet soft_difference_scalar() { return kernel_set<SoftDifference, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(soft_sum_simd);
HWY_EXPORT(soft_overlap_simd);
HWY_EXPORT(soft_difference_simd);

// One sum or difference of two doubles is rounded alike everywhere and monotone: the ends are exact.
static Range sum_range(const void*, const Box&, std::span<const Range> args) {
  return {args[0].lo + args[1].lo, args[0].hi + args[1].hi};
}
static Shortcut sum_shortcut(const void*, const Box&, std::span<const Range> args) {
  if (is(args[0], 0.0)) return Shortcut::to_argument(1);
  return is(args[1], 0.0) ? Shortcut::to_argument(0) : Shortcut{};
}

static Merged added_soft_ellipsoid_of(const void*, std::size_t, const Op& inner, const void* inner_body) {
  if (&inner != &op_for<SoftEllipsoid>()) return {};
  const AddedSoftEllipsoid both{static_cast<const SoftEllipsoid*>(inner_body)->softness};
  return {&op_for<AddedSoftEllipsoid>(), std::make_shared<const AddedSoftEllipsoid>(both)};
}

static Range overlap_range(const void* body, const Box&, std::span<const Range> args) {
  const double offset = static_cast<const SoftOverlap*>(body)->offset;
  return {std::max(0.0, args[0].lo - offset), std::max(0.0, args[0].hi - offset)};
}
static Shortcut overlap_shortcut(const void* body, const Box&, std::span<const Range> args) {
  return args[0].hi <= static_cast<const SoftOverlap*>(body)->offset ? Shortcut::to_constant(0.0)
                                                                     : Shortcut{};
}

static LinearBound overlap_linear(const void* body, const LinearInput& in) {
  const double offset = static_cast<const SoftOverlap*>(body)->offset;
  const Range f = in.ranges[0];
  return positive_part(in.args[0] + constant_bound({-offset, -offset}), {f.lo - offset, f.hi - offset});
}

static Range difference_range(const void*, const Box&, std::span<const Range> args) {
  return {std::max(0.0, args[0].lo - args[1].hi), std::max(0.0, args[0].hi - args[1].lo)};
}
static LinearBound difference_linear(const void*, const LinearInput& in) {
  const Range a = in.ranges[0], b = in.ranges[1];
  return positive_part(in.args[0] + -1.0 * in.args[1], {a.lo - b.hi, a.hi - b.lo});
}
static Shortcut difference_shortcut(const void*, const Box&, std::span<const Range> args) {
  if (is(args[1], 0.0) && args[0].lo >= 0.0) return Shortcut::to_argument(0);
  const bool gone = is(args[0], 0.0) && args[1].lo >= 0.0;
  return gone || (args[1].lo > 0.0 && args[0].hi <= args[1].lo) ? Shortcut::to_constant(0.0) : Shortcut{};
}

}  // namespace detail

template <>
const Op& op_for<detail::SoftSum>() {
  using namespace detail;
  static const Op op = [] {
    Op o{"soft_sum",
         HWY_DYNAMIC_DISPATCH(soft_sum_simd)(),
         HWY_STATIC_DISPATCH(soft_sum_scalar)(),
         sum_range,
         sum_shortcut,
         added_bound};
    o.merge = added_soft_ellipsoid_of;
    return o;
  }();
  return op;
}
template <>
const Op& op_for<detail::SoftOverlap>() {
  using namespace detail;
  static const Op op{"soft_overlap",
                     HWY_DYNAMIC_DISPATCH(soft_overlap_simd)(),
                     HWY_STATIC_DISPATCH(soft_overlap_scalar)(),
                     overlap_range,
                     overlap_shortcut,
                     overlap_linear};
  return op;
}
template <>
const Op& op_for<detail::SoftDifference>() {
  using namespace detail;
  static const Op op{"soft_difference",
                     HWY_DYNAMIC_DISPATCH(soft_difference_simd)(),
                     HWY_STATIC_DISPATCH(soft_difference_scalar)(),
                     difference_range,
                     difference_shortcut,
                     difference_linear};
  return op;
}

}  // namespace blendwright
#endif
