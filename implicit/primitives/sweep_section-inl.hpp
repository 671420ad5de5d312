// (1)-(3) of sweep_section.hpp, in any number.
#if defined(BLENDWRIGHT_SWEEP_SECTION_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BLENDWRIGHT_SWEEP_SECTION_INL_HPP
#undef BLENDWRIGHT_SWEEP_SECTION_INL_HPP
#else
#define BLENDWRIGHT_SWEEP_SECTION_INL_HPP
#endif

#include "implicit/primitives/profile-inl.hpp"
#include "implicit/primitives/sweep_section.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
using MaskOf = decltype(LaneOf<T>{} < LaneOf<T>{});

/// d by (3) where `beyond` holds, else by (2); alpha matters only where it holds.
template <class T>
HWY_INLINE T section_distance(const Section& b, const T& u0, const T& v0, const T& k, const T& alpha,
                              MaskOf<T> beyond) {
  T u = u0, v = v0;
  if (b.twist != 0.0) {
    using L = LaneOf<T>;
    const T phi = k * b.twist;
    const L c = lane::cos(value_of(phi)), s = lane::sin(value_of(phi));
    const T cosine = chain(phi, c, -s, -c), sine = chain(phi, s, c, -s);
    u = cosine * u0 + sine * v0;
    v = cosine * v0 - sine * u0;
  }
  T q = gauge(b.profile, u, v);
  q = b.ds == 0.0 ? q * (1.0 / b.s0) : q / (k * b.ds + b.s0);
  if (!any(beyond)) return q;  // choose() takes q in every lane then
  const T both[2] = {q, absolute(alpha * b.inverse_cap)};
  return choose<T>(beyond, p_norm(both, b.m, b.inverse_m), q);
}

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // once per instruction set
