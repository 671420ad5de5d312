// Fields within what polynomial operators can take.
#if defined(BLENDWRIGHT_FUNCTION_SATURATE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BLENDWRIGHT_FUNCTION_SATURATE_INL_HPP
#undef BLENDWRIGHT_FUNCTION_SATURATE_INL_HPP
#else
#define BLENDWRIGHT_FUNCTION_SATURATE_INL_HPP
#endif

#include "implicit/number/number-inl.hpp"
#include "implicit/operators/function_join.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// x, or +-saturation without derivatives beyond that.
template <class T>
HWY_INLINE T saturated(const T& x) {
  using L = LaneOf<T>;
  const L v = value_of(x), most = saturation;
  return choose<T>(lane::abs(v) <= most, x, constant<T>(select(v < L(0.0), -most, most)));
}
/// max(x, 0); derivatives 0 where x <= 0.
template <class T>
HWY_INLINE T positive_part(const T& x) {
  return choose<T>(value_of(x) > LaneOf<T>(0.0), x, T(0.0));
}

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // once per instruction set
