// The overflow-safe p-norm, used by most bodies.
#if defined(BLENDWRIGHT_P_NORM_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BLENDWRIGHT_P_NORM_INL_HPP
#undef BLENDWRIGHT_P_NORM_INL_HPP
#else
#define BLENDWRIGHT_P_NORM_INL_HPP
#endif

#include "implicit/number/number-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// N_n(u_1, ..., u_k) = (sum u_i^n)^(1/n), u_i >= 0, n > 0; 0 when all are 0. Evaluated as m (sum
/// (u_i/m)^n)^(1/n) with m = max u_i: the bracket lies in [1, k], so nothing overflows. m counts as constant
/// in the derivatives, which is exact because N does not depend on it.
template <class T, std::size_t K>
HWY_INLINE T p_norm(const T (&u)[K], const Power& n, const Power& inverse_n) {
  using L = LaneOf<T>;
  if (n.exponent == 1.0) {
    T sum = u[0];
    for (std::size_t i = 1; i < K; ++i) sum = sum + u[i];
    return sum;
  }
  L m = value_of(u[0]);
  for (std::size_t i = 1; i < K; ++i) m = lane::max(m, value_of(u[i]));
  const L scale = select(m > L(0.0), m, L(1.0)), inverse = L(1.0) / scale;
  T sum = power(scaled(u[0], inverse), n);
  for (std::size_t i = 1; i < K; ++i) sum = sum + power(scaled(u[i], inverse), n);
  return scaled(power(sum, inverse_n), scale);
}

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // once per instruction set
