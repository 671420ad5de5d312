// The gauge of a profile, (1)-(4) of profile.hpp, in any number.
#if defined(BLENDWRIGHT_PROFILE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BLENDWRIGHT_PROFILE_INL_HPP
#undef BLENDWRIGHT_PROFILE_INL_HPP
#else
#define BLENDWRIGHT_PROFILE_INL_HPP
#endif

#include "implicit/number/p_norm-inl.hpp"
#include "implicit/primitives/profile.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// Polar coordinates; all 0 at the origin. inverse: 1/r, 0 for r <= 1e-60, so that no
/// derivative overflows.
template <class L>
struct Polar {
  L r, cosine, sine, inverse;
};
template <class L>
HWY_INLINE Polar<L> polar(L u, L v) {
  const L m = lane::max(lane::abs(u), lane::abs(v));
  const auto regular = m > L(1e-300);
  const L scale = select(regular, m, L(1.0)), i = L(1.0) / scale;
  const L a = u * i, b = v * i, h = lane::sqrt(a * a + b * b), j = L(1.0) / select(regular, h, L(1.0));
  const L zero = 0.0;
  return {select(regular, h * scale, zero), select(regular, a * j, zero), select(regular, b * j, zero),
          select(m > L(1e-60), j * i, zero)};
}

/// r = sqrt(u^2 + v^2); derivatives 0 at 0.
template <class T>
HWY_INLINE T hypotenuse(const T& u, const T& v) {
  const auto p = polar(value_of(u), value_of(v));
  return chain(u, v, p.r, p.cosine, p.sine, p.sine * p.sine * p.inverse, -(p.sine * p.cosine * p.inverse),
               p.cosine * p.cosine * p.inverse);
}

/// (cosine, sine) of k times the angle, by repeated squaring of cosine + i sine; k >= 1. The error grows like
/// k ulp.
template <class L>
struct Direction {
  L cosine, sine;
};
template <class L>
HWY_INLINE Direction<L> times(Direction<L> d, int k) {
  Direction<L> r = d;
  for (int bit = 30 - std::countl_zero(static_cast<unsigned>(k)); bit >= 0; --bit) {
    const L s = r.sine * r.cosine;
    r = {r.cosine * r.cosine - r.sine * r.sine, s + s};
    if ((k >> bit) & 1) r = {r.cosine * d.cosine - r.sine * d.sine, r.cosine * d.sine + r.sine * d.cosine};
  }
  const L one = 1.0;
  return {lane::max(-one, lane::min(one, r.cosine)), lane::max(-one, lane::min(one, r.sine))};
}
/// Half the angle, but for the sign of both numbers.
template <class L>
HWY_INLINE Direction<L> half(Direction<L> d) {
  const L big = lane::sqrt(L(0.5) * (L(1.0) + lane::abs(d.cosine))), small = L(0.5) * d.sine / big;
  const auto ahead = d.cosine >= L(0.0);
  return {select(ahead, big, small), select(ahead, small, big)};
}

/// q = 1/rho with its derivatives by theta.
template <class L>
struct ReciprocalRadius {
  L q, q1, q2;
};
// (3): q = (1 + eps) / (a D), D = 1 + eps cos k theta.
template <class L>
HWY_INLINE ReciprocalRadius<L> rose_reciprocal(const Profile& p, Direction<L> d) {
  const Direction<L> kd = times(d, p.k);
  const double k = p.k, scale = (1.0 + p.eps) / p.a;
  const L i = L(1.0) / (L(1.0) + L(p.eps) * kd.cosine), slope = L(p.eps * k) * kd.sine * i;
  const L q = L(scale) * i;
  return {q, q * slope, q * (L(p.eps * k * k) * kd.cosine * i + L(2.0) * slope * slope)};
}
// (4): q = (1 + sigma |s|^m) / a, s = sin(k theta / 2). The angle is halved before it is multiplied, so that
// |s| is exact near the tips. At s = 0: |s|' = 0; (s^2)'' = 2; higher derivatives of other powers 0.
template <class L>
HWY_INLINE ReciprocalRadius<L> star_reciprocal(const Profile& p, Direction<L> d) {
  const Direction<L> h = p.k % 2 == 0 ? times(d, p.k / 2) : times(half(d), p.k);
  const L s = lane::abs(h.sine), f = lane_power(s, p.m);
  const auto regular = s > L(1e-150);
  const L i = L(1.0) / select(regular, s, L(1.0));
  const L f1 = select(regular, L(p.m.exponent) * (f * i), L(0.0));
  const L f2 = p.m.exponent == 2.0 ? L(2.0) : L(p.m.exponent - 1.0) * (f1 * i);
  const double scale = 1.0 / p.a, half_k = 0.5 * p.k;
  const L c = h.cosine, weight = L(scale * p.sigma);
  return {L(scale) + weight * f, weight * L(half_k) * f1 * lane::sign(h.sine) * c,
          weight * L(half_k * half_k) * (f2 * (c * c) - f1 * s)};
}

/// g(u, v).
template <class T>
HWY_INLINE T gauge(const Profile& p, const T& u, const T& v) {
  using L = LaneOf<T>;
  if (p.kind == Profile::Kind::lp) {
    if (p.n.exponent == 2.0) return hypotenuse(u * (1.0 / p.a), v * (1.0 / p.b));
    const T w[2] = {u * (1.0 / p.a), v * (1.0 / p.b)};
    return p_norm(w, p.n, p.inverse_n);
  }
  const Polar<L> at = polar(value_of(u), value_of(v));
  const Direction<L> d{at.cosine, at.sine};
  const ReciprocalRadius<L> q = p.kind == Profile::Kind::rose ? rose_reciprocal(p, d) : star_reciprocal(p, d);
  // g_u = c q - s q', g_v = s q + c q'; the second derivatives are (q + q'')/r across the ray, 0 along it.
  const L c = at.cosine, s = at.sine, bend = (q.q + q.q2) * at.inverse;
  return chain(u, v, at.r * q.q, c * q.q - s * q.q1, s * q.q + c * q.q1, bend * (s * s), -(bend * (s * c)),
               bend * (c * c));
}

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // once per instruction set
