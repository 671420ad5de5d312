#include "implicit/scene/level_map.hpp"

#include "implicit/number/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/scene/level_map.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const LevelMap& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T n = in.arg(0);
  return chain(n, L(b.factor) * value_of(n) + L(b.shift), L(b.factor));
}

template <class T>
HWY_INLINE T evaluate(const LevelExponential& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T n = in.arg(0);
  const L v = -(L(b.factor) * value_of(n) + L(b.shift)), highest = 300.0, lowest = -700.0;
  const auto over = v > highest, under = v < lowest;
  const L f = lane::exp(select(over, highest, select(under, lowest, v)));
  const L f1 = select(over || under, L(0.0), L(-b.factor) * f);
  return chain(n, select(over, L(std::numeric_limits<double>::infinity()), f), f1,
               select(over || under, L(0.0), f));
}

KernelSet level_map_simd() { return kernel_set<LevelMap, Simd>(); }
KernelSet level_exponential_simd() { return kernel_set<LevelExponential, Simd>(); }
#if HWY_ONCE
KernelSet level_map_scalar() { return kernel_set<LevelMap, double>(); }
KernelSet level_exponential_scalar() { return kernel_set<LevelExponential, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "implicit/eval/linear_rules.hpp"

namespace blendwright {
namespace detail {
HWY_EXPORT(level_map_simd);
HWY_EXPORT(level_exponential_simd);

/// One sum, rounded alike everywhere.
static Range level_map_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const LevelMap*>(body);
  const double lo = b.factor * args[0].lo + b.shift, hi = b.factor * args[0].hi + b.shift;
  return {std::min(lo, hi), std::max(lo, hi)};
}
/// Rises with -phi. The exponent is rounded alike everywhere, its exponential has an error of some ulp.
static Range level_exponential_range(const void* body, const Box&, std::span<const Range> args) {
  return range_by_arguments(op_for<LevelExponential>(), body, args,
                            {static_cast<const LevelExponential*>(body)->factor < 0.0});
}

static LinearBound level_map_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const LevelMap*>(body);
  return b.factor * in.args[0] + constant_bound({b.shift, b.shift});
}
/// The exponential is convex.
static LinearBound level_exponential_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const LevelExponential*>(body);
  const LinearBound exponent = -1.0 * (b.factor * in.args[0] + constant_bound({b.shift, b.shift}));
  const double lo = -b.factor * in.ranges[0].lo - b.shift, hi = -b.factor * in.ranges[0].hi - b.shift;
  const Range range{std::min(lo, hi), std::max(lo, hi)};
  if (range.lo < -700.0 || range.hi > 300.0)
    return constant_bound(level_exponential_range(body, in.local, in.ranges));
  const double at = std::exp(exponent.value), last = std::exp(range.hi);
  return of_convex(exponent, range, {at, at, std::exp(range.lo), last}, 4.0 * range_slack * last);
}
}  // namespace detail

template <>
const Op& op_for<detail::LevelMap>() {
  using namespace detail;
  static const Op op{"level_map",
                     HWY_DYNAMIC_DISPATCH(level_map_simd)(),
                     HWY_STATIC_DISPATCH(level_map_scalar)(),
                     level_map_range,
                     nullptr,
                     level_map_linear};
  return op;
}
template <>
const Op& op_for<detail::LevelExponential>() {
  using namespace detail;
  static const Op op{"level_exponential",
                     HWY_DYNAMIC_DISPATCH(level_exponential_simd)(),
                     HWY_STATIC_DISPATCH(level_exponential_scalar)(),
                     level_exponential_range,
                     nullptr,
                     level_exponential_linear};
  return op;
}

}  // namespace blendwright
#endif
