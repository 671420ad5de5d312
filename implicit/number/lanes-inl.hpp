// The lanes that numbers are made of: one double, or one vector of them, with the same functions for both.
#if defined(BLENDWRIGHT_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BLENDWRIGHT_LANES_INL_HPP
#undef BLENDWRIGHT_LANES_INL_HPP
#else
#define BLENDWRIGHT_LANES_INL_HPP
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "implicit/number/power.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using SimdTag = hn::ScalableTag<double>;

/// The truth of a comparison, per lane.
struct SimdMask {
  hn::Mask<SimdTag> m;
};

/// One vector of doubles. Mixes with double.
struct Simd {
  hn::Vec<SimdTag> v;
  HWY_INLINE Simd() : v(hn::Zero(SimdTag())) {}
  HWY_INLINE Simd(double x) : v(hn::Set(SimdTag(), x)) {}  // NOLINT: constants mix freely
  HWY_INLINE explicit Simd(hn::Vec<SimdTag> x) : v(x) {}
};

HWY_INLINE Simd operator+(Simd a, Simd b) { return Simd(hn::Add(a.v, b.v)); }
HWY_INLINE Simd operator-(Simd a, Simd b) { return Simd(hn::Sub(a.v, b.v)); }
HWY_INLINE Simd operator*(Simd a, Simd b) { return Simd(hn::Mul(a.v, b.v)); }
HWY_INLINE Simd operator/(Simd a, Simd b) { return Simd(hn::Div(a.v, b.v)); }
HWY_INLINE Simd operator-(Simd a) { return Simd(hn::Neg(a.v)); }
HWY_INLINE SimdMask operator<(Simd a, Simd b) { return {hn::Lt(a.v, b.v)}; }
HWY_INLINE SimdMask operator<=(Simd a, Simd b) { return {hn::Le(a.v, b.v)}; }
HWY_INLINE SimdMask operator>(Simd a, Simd b) { return {hn::Gt(a.v, b.v)}; }
HWY_INLINE SimdMask operator>=(Simd a, Simd b) { return {hn::Ge(a.v, b.v)}; }
HWY_INLINE SimdMask operator==(Simd a, Simd b) { return {hn::Eq(a.v, b.v)}; }
HWY_INLINE SimdMask operator&&(SimdMask a, SimdMask b) { return {hn::And(a.m, b.m)}; }
HWY_INLINE SimdMask operator||(SimdMask a, SimdMask b) { return {hn::Or(a.m, b.m)}; }
HWY_INLINE SimdMask operator!(SimdMask a) { return {hn::Not(a.m)}; }
HWY_INLINE Simd select(SimdMask m, Simd a, Simd b) { return Simd(hn::IfThenElse(m.m, a.v, b.v)); }
HWY_INLINE double select(bool m, double a, double b) { return m ? a : b; }
/// Whether the comparison holds in any lane, in all lanes.
HWY_INLINE bool any(SimdMask m) { return !hn::AllFalse(SimdTag(), m.m); }
HWY_INLINE bool all(SimdMask m) { return hn::AllTrue(SimdTag(), m.m); }
HWY_INLINE bool any(bool m) { return m; }
HWY_INLINE bool all(bool m) { return m; }

/// a * b + c, rounded once where the instruction set can.
HWY_INLINE Simd multiply_add(Simd a, Simd b, Simd c) { return Simd(hn::MulAdd(a.v, b.v, c.v)); }
HWY_INLINE double multiply_add(double a, double b, double c) { return a * b + c; }

// Elementary functions of lanes; errors of the vector ones are at most 4 ulp (Highway's contrib/math).
namespace lane {
HWY_INLINE Simd abs(Simd x) { return Simd(hn::Abs(x.v)); }
HWY_INLINE Simd sqrt(Simd x) { return Simd(hn::Sqrt(x.v)); }
HWY_INLINE Simd min(Simd a, Simd b) { return select(b < a, b, a); }
HWY_INLINE Simd max(Simd a, Simd b) { return select(b > a, b, a); }
HWY_INLINE Simd exp(Simd x) { return Simd(hn::Exp(SimdTag(), x.v)); }
HWY_INLINE Simd log(Simd x) { return Simd(hn::Log(SimdTag(), x.v)); }
HWY_INLINE Simd log1p(Simd x) { return Simd(hn::Log1p(SimdTag(), x.v)); }
HWY_INLINE Simd expm1(Simd x) { return Simd(hn::Expm1(SimdTag(), x.v)); }
HWY_INLINE Simd sin(Simd x) { return Simd(hn::Sin(SimdTag(), x.v)); }
HWY_INLINE Simd cos(Simd x) { return Simd(hn::Cos(SimdTag(), x.v)); }
HWY_INLINE Simd atan(Simd x) { return Simd(hn::Atan(SimdTag(), x.v)); }
HWY_INLINE double abs(double x) { return std::abs(x); }
HWY_INLINE double sqrt(double x) { return std::sqrt(x); }
HWY_INLINE double min(double a, double b) { return b < a ? b : a; }
HWY_INLINE double max(double a, double b) { return b > a ? b : a; }
HWY_INLINE double exp(double x) { return std::exp(x); }
HWY_INLINE double log(double x) { return std::log(x); }
HWY_INLINE double log1p(double x) { return std::log1p(x); }
HWY_INLINE double expm1(double x) { return std::expm1(x); }
HWY_INLINE double sin(double x) { return std::sin(x); }
HWY_INLINE double cos(double x) { return std::cos(x); }
HWY_INLINE double atan(double x) { return std::atan(x); }
/// The largest power of two that is not larger than x, a normal number > 0; and 1/p of a power of two p.
HWY_INLINE Simd power_of_two_below(Simd x) {
  const hn::RebindToUnsigned<SimdTag> bits;
  const auto exponent = hn::And(hn::BitCast(bits, x.v), hn::Set(bits, 0x7FF0000000000000ull));
  return Simd(hn::BitCast(SimdTag(), exponent));
}
HWY_INLINE Simd inverse_power_of_two(Simd p) {
  const hn::RebindToUnsigned<SimdTag> bits;
  const auto b = hn::Sub(hn::Set(bits, 0x7FE0000000000000ull), hn::BitCast(bits, p.v));
  return Simd(hn::BitCast(SimdTag(), b));
}
HWY_INLINE double power_of_two_below(double x) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & 0x7FF0000000000000ull);
}
HWY_INLINE double inverse_power_of_two(double p) { return 1.0 / p; }
/// -1, 0 or 1.
template <class L>
HWY_INLINE L sign(L x) {
  return select(x > L(0.0), L(1.0), select(x < L(0.0), L(-1.0), L(0.0)));
}
/// The angle of (x, y) in (-pi, pi]; 0 at the origin.
template <class L>
HWY_INLINE L atan2(L y, L x) {
  const L ax = abs(x), ay = abs(y);
  const auto steep = ay > ax;
  const L large = select(steep, ay, ax), small = select(steep, ax, ay);
  const L t = atan(select(large > L(0.0), small / large, L(0.0)));
  const L first = select(steep, L(1.57079632679489661923) - t, t);
  const L half = select(x < L(0.0), L(3.14159265358979323846) - first, first);
  return select(y < L(0.0), -half, half);
}
}  // namespace lane

// Powers of real exponents. With x = 2^e m, sqrt(1/2) <= m < sqrt(2), and s = (m - 1) / (m + 1),
//   log2 x = e + s P(s^2),   2^t = 2^k (1 + f Q(f)),   k = t rounded, f = t - k.                         (1)
// P interpolates log2((1+s)/(1-s))/s at 7 Chebyshev nodes (relative error 2.1e-16), Q (2^f - 1)/f at 11
// (2.0e-17 of 2^f). Rounding adds at most 4 ulp to log2 x and 2 ulp to 2^t, so that the relative error of
// x^n is at most 1e-15 (1 + |n ln x|), and 1^n is exactly 1.

/// log2 x for normal x > 0.
HWY_INLINE Simd log2_of_normal(Simd x) {
  const hn::RebindToUnsigned<SimdTag> bits;
  const SimdTag d;
  const auto b = hn::BitCast(bits, x.v);
  const auto one = hn::Set(bits, 0x3FF0000000000000ull);
  const auto moved = hn::Add(b, hn::Set(bits, 0x3FF0000000000000ull - 0x3FE6A09E667F3BCDull));
  // The number 2^52 + 1023 + e has 1023 + e in its last bits.
  const auto e_bits = hn::Or(hn::ShiftRight<52>(moved), hn::Set(bits, 0x4330000000000000ull));
  const Simd e = Simd(hn::BitCast(d, e_bits)) - Simd(0x1p52 + 1023.0);
  const auto shift = hn::And(moved, hn::Set(bits, 0xFFF0000000000000ull));
  const Simd m = Simd(hn::BitCast(d, hn::Add(hn::Sub(b, shift), one)));
  const Simd s = (m - 1.0) / (m + 1.0), z = s * s, zz = z * z;
  const Simd low = multiply_add(multiply_add(Simd(0.4121984020482744), z, 0.5770780172463286), zz,
                                multiply_add(Simd(0.9617966939243345), z, 2.885390081777927));
  const Simd high = multiply_add(Simd(0.24291608542091292), zz,
                                 multiply_add(Simd(0.2614442493504987), z, 0.3206163881322994));
  return multiply_add(s, multiply_add(high, zz * zz, low), e);
}

/// 2^t for -1022 < t < 1024.
HWY_INLINE Simd exp2_of_moderate(Simd t) {
  const hn::RebindToUnsigned<SimdTag> bits;
  const SimdTag d;
  constexpr double rounder = 0x1.8p52;  // adding it leaves k in the last bits
  const Simd r = t + rounder, f = t - (r - rounder), ff = f * f;
  const Simd q0 = multiply_add(Simd(0.24022650695910097), f, 0.6931471805599453);
  const Simd q2 = multiply_add(Simd(0.009618129107606888), f, 0.0555041086648216);
  const Simd q4 = multiply_add(Simd(0.0001540353044173605), f, 0.0013333558146416936);
  const Simd q6 = multiply_add(Simd(1.321544258792169e-06), f, 1.525273382983612e-05);
  const Simd q8 = multiply_add(multiply_add(Simd(4.4549605981865186e-10), f, 7.072585949269223e-09), f,
                               1.0178062445845774e-07);
  const Simd q = multiply_add(multiply_add(multiply_add(multiply_add(q8, ff, q6), ff, q4), ff, q2), ff, q0);
  const Simd p = multiply_add(q, f, 1.0);
  const auto k = hn::ShiftLeft<52>(hn::BitCast(bits, r.v));
  return Simd(hn::BitCast(d, hn::Add(hn::BitCast(bits, p.v), k)));
}

/// Lane power by repeated squaring; n >= 1.
template <class L>
HWY_INLINE L integer_power(L x, int n) {
  L r = x;
  for (int bit = 30 - std::countl_zero(static_cast<unsigned>(n)); bit >= 0; --bit) {
    r = r * r;
    if ((n >> bit) & 1) r = r * x;
  }
  return r;
}

/// x^n where x and x^n are normal numbers and n is no integer; else any number.
HWY_INLINE Simd real_power(Simd x, const Power& n) {
  return exp2_of_moderate(Simd(n.exponent) * log2_of_normal(x));
}
HWY_INLINE double real_power(double x, const Power& n) { return std::pow(x, n.exponent); }

/// x^n for 0 <= x <= 1; 0 for x < n.floor when n is no integer.
template <class L>
HWY_INLINE L ratio_power(L x, const Power& n) {
  switch (n.kind) {
    case Power::Kind::integer:
      return integer_power(x, n.integer);
    case Power::Kind::square_root:
      return lane::sqrt(x);
    default:
      return select(x >= L(n.floor), real_power(x, n), L(0.0));
  }
}
/// x^n for lanes, x >= 0; infinite where x > n.ceiling and 0 where x < n.floor when n is no integer.
template <class L>
HWY_INLINE L lane_power(L x, const Power& n) {
  const L f = ratio_power(x, n);
  if (n.kind != Power::Kind::real) return f;
  return select(x > L(n.ceiling), L(std::numeric_limits<double>::infinity()), f);
}

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // once per instruction set
