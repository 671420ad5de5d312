#include "implicit/scene/level_conversion.hpp"

#include "implicit/eval/linear_shapes.hpp"
#include "implicit/number/targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/scene/level_conversion.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const LevelShift&, const Inputs<T>& in) {
  const T x = in.arg(0);
  return chain(x, value_of(x) - LaneOf<T>(1.0), LaneOf<T>(1.0));
}

template <class T>
HWY_INLINE T evaluate(const LevelLogarithm&, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T x = in.arg(0);
  const L v = value_of(x), tiny = 1e-100, huge = std::numeric_limits<double>::max();
  const auto regular = v > tiny && v <= huge;
  const L inside = select(regular, v, L(1.0));
  const L f = select(v > huge, v, lane::log(select(regular, v, tiny)));
  const L f1 = select(regular, L(1.0) / inside, L(0.0));
  return chain(x, f, f1, -(f1 * f1));
}

KernelSet level_shift_simd() { return kernel_set<LevelShift, Simd>(); }
KernelSet level_logarithm_simd() { return kernel_set<LevelLogarithm, Simd>(); }
#if HWY_ONCE
KernelSet level_shift_scalar() { return kernel_set<LevelShift, double>(); }
KernelSet level_logarithm_scalar() { return kernel_set<LevelLogarithm, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(level_shift_simd);
HWY_EXPORT(level_logarithm_simd);

// Both rise with their argument: the subtraction is rounded once, alike everywhere, and the error of a
// logarithm is relative to its own value, also near x = 1.
static Op level_shift_op() {
  return {"level_shift",
          HWY_DYNAMIC_DISPATCH(level_shift_simd)(),
          HWY_STATIC_DISPATCH(level_shift_scalar)(),
          [](const void* body, const Box&, std::span<const Range> args) {
            return range_by_arguments(op_for<LevelShift>(), body, args, {true});
          },
          nullptr,
          [](const void*, const LinearInput& in) {
            return in.args[0] + constant_bound({-1.0, -1.0});
          }};
}
static Op level_logarithm_op() {
  return {"level_logarithm",
          HWY_DYNAMIC_DISPATCH(level_logarithm_simd)(),
          HWY_STATIC_DISPATCH(level_logarithm_scalar)(),
          [](const void* body, const Box&, std::span<const Range> args) {
            return range_by_arguments(op_for<LevelLogarithm>(), body, args, {true});
          },
          nullptr,
          [](const void*, const LinearInput& in) {
            if (!(in.ranges[0].lo > 1e-100)) return constant_bound(Range::everything());
            return logarithm_bound(in.args[0], in.ranges[0]);
          }};
}

}  // namespace detail

template <>
const Op& op_for<detail::LevelShift>() {
  static const Op op = detail::level_shift_op();
  return op;
}
template <>
const Op& op_for<detail::LevelLogarithm>() {
  static const Op op = detail::level_logarithm_op();
  return op;
}

}  // namespace blendwright
#endif
