// Overflow-safe norms, used by most bodies.
#if defined(BLENDWRIGHT_P_NORM_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BLENDWRIGHT_P_NORM_INL_HPP
#undef BLENDWRIGHT_P_NORM_INL_HPP
#else
#define BLENDWRIGHT_P_NORM_INL_HPP
#endif

#include "implicit/number/number-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// What a norm is divided by while it is summed: its largest term m, kept in [1e-60, the largest number]. The
/// inverse and its square are numbers, so that no derivative overflows; terms that are all below 1e-60 are
/// the origin to 1e-60.
template <class L>
HWY_INLINE L norm_scale(L m) {
  return lane::min(lane::max(m, L(1e-60)), L(std::numeric_limits<double>::max()));
}

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
  const L scale = norm_scale(m), inverse = L(1.0) / scale;
  T sum = power(scaled(u[0], inverse), n);
  for (std::size_t i = 1; i < K; ++i) sum = sum + power(scaled(u[i], inverse), n);
  return scaled(power(sum, inverse_n), scale);
}

/// The same of k >= 1 terms u_i = terms(i) that are computed where they are needed, twice.
template <class T, class Terms>
HWY_INLINE T p_norm_of(const Terms& terms, std::size_t k, const Power& n, const Power& inverse_n) {
  using L = LaneOf<T>;
  T sum = terms(0);
  if (n.exponent == 1.0) {
    for (std::size_t i = 1; i < k; ++i) sum = sum + terms(i);
    return sum;
  }
  L m = value_of(sum);
  for (std::size_t i = 1; i < k; ++i) m = lane::max(m, value_of(terms(i)));
  const L scale = norm_scale(m), inverse = L(1.0) / scale;
  sum = power(scaled(sum, inverse), n);
  for (std::size_t i = 1; i < k; ++i) sum = sum + power(scaled(terms(i), inverse), n);
  return scaled(power(sum, inverse_n), scale);
}

/// |x| = (sum x_i^2)^(1/2) of coordinates of either sign, overflow-safe in the same way; derivatives 0 at 0.
template <class T, std::size_t K>
HWY_INLINE T length(const T (&x)[K]) {
  using L = LaneOf<T>;
  L m = lane::abs(value_of(x[0]));
  for (std::size_t i = 1; i < K; ++i) m = lane::max(m, lane::abs(value_of(x[i])));
  const L scale = norm_scale(m), inverse = L(1.0) / scale;
  T sum = square(scaled(x[0], inverse));
  for (std::size_t i = 1; i < K; ++i) sum = sum + square(scaled(x[i], inverse));
  return scaled(root(sum), scale);
}

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // once per instruction set
