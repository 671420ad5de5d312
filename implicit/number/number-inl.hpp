// The numbers that node bodies are written in. A body is a template over its number T and is compiled for
//   double, Simd                     values (one point, or one vector of points)
//   Dual<double>, Dual<Simd>         value and gradient
//   Dual2<double>, Dual2<Simd>       value, gradient and second derivatives
// and, for Simd, once per instruction set: this header is included again for each of them.
//
// A function f of numbers is given by its partial derivatives: chain(x, f, f') and chain(x, y, f, fx, fy,
// ...). What a number type does not carry is never computed. Where a derivative does not exist or is infinite
// the functions below give 0 (the conventions of each are at its declaration): no NaN, no infinity leaves
// them.
#if defined(BLENDWRIGHT_NUMBER_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BLENDWRIGHT_NUMBER_INL_HPP
#undef BLENDWRIGHT_NUMBER_INL_HPP
#else
#define BLENDWRIGHT_NUMBER_INL_HPP
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <cmath>
#include <cstddef>
#include <limits>

#include "implicit/number/power.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// ---- Lanes: double and Simd -------------------------------------------------------------------------

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

// ---- Numbers with derivatives -----------------------------------------------------------------------

template <class L>
struct Dual {
  L v{}, d[3]{};
  HWY_INLINE Dual() = default;
  HWY_INLINE Dual(double x) : v(x) {}  // NOLINT: constants mix freely
};

/// h: xx, yy, zz, xy, xz, yz.
template <class L>
struct Dual2 {
  L v{}, d[3]{}, h[6]{};
  HWY_INLINE Dual2() = default;
  HWY_INLINE Dual2(double x) : v(x) {}  // NOLINT: constants mix freely
};

inline constexpr int hessian_row[6] = {0, 1, 2, 0, 0, 1};
inline constexpr int hessian_column[6] = {0, 1, 2, 1, 2, 2};

/// The lane type of a number, and how many derivatives it carries.
template <class T>
struct NumberTraits {
  using Lane = T;
  static constexpr int order = 0;
};
template <class L>
struct NumberTraits<Dual<L>> {
  using Lane = L;
  static constexpr int order = 1;
};
template <class L>
struct NumberTraits<Dual2<L>> {
  using Lane = L;
  static constexpr int order = 2;
};
template <class T>
using LaneOf = typename NumberTraits<T>::Lane;

HWY_INLINE double value_of(double x) { return x; }
HWY_INLINE Simd value_of(Simd x) { return x; }
template <class L>
HWY_INLINE L value_of(const Dual<L>& x) {
  return x.v;
}
template <class L>
HWY_INLINE L value_of(const Dual2<L>& x) {
  return x.v;
}

/// The number without derivatives, as a constant of type T.
template <class T>
HWY_INLINE T constant(LaneOf<T> x) {
  if constexpr (NumberTraits<T>::order == 0) {
    return x;
  } else {
    T t;
    t.v = x;
    return t;
  }
}

/// f(x) from the value f, f' and f'' at x.
template <class T>
HWY_INLINE T chain(const T& x, LaneOf<T> f, [[maybe_unused]] LaneOf<T> f1,
                   [[maybe_unused]] LaneOf<T> f2 = 0.0) {
  if constexpr (NumberTraits<T>::order == 0) {
    return f;
  } else {
    T r;
    r.v = f;
    for (int i = 0; i < 3; ++i) r.d[i] = f1 * x.d[i];
    if constexpr (NumberTraits<T>::order == 2)
      for (int k = 0; k < 6; ++k)
        r.h[k] = multiply_add(f1, x.h[k], f2 * (x.d[hessian_row[k]] * x.d[hessian_column[k]]));
    return r;
  }
}

/// f(x, y) from its value and partial derivatives.
template <class T>
HWY_INLINE T chain(const T& x, const T& y, LaneOf<T> f, [[maybe_unused]] LaneOf<T> fx,
                   [[maybe_unused]] LaneOf<T> fy, [[maybe_unused]] LaneOf<T> fxx = 0.0,
                   [[maybe_unused]] LaneOf<T> fxy = 0.0, [[maybe_unused]] LaneOf<T> fyy = 0.0) {
  if constexpr (NumberTraits<T>::order == 0) {
    return f;
  } else {
    T r;
    r.v = f;
    for (int i = 0; i < 3; ++i) r.d[i] = multiply_add(fx, x.d[i], fy * y.d[i]);
    if constexpr (NumberTraits<T>::order == 2)
      for (int k = 0; k < 6; ++k) {
        const int a = hessian_row[k], b = hessian_column[k];
        r.h[k] = multiply_add(fx, x.h[k], fy * y.h[k]) + fxx * (x.d[a] * x.d[b]) +
                 fxy * (x.d[a] * y.d[b] + x.d[b] * y.d[a]) + fyy * (y.d[a] * y.d[b]);
      }
    return r;
  }
}

/// The number with every component taken from a where m holds, else from b.
template <class T>
HWY_INLINE T choose(decltype(LaneOf<T>{} < LaneOf<T>{}) m, const T& a, const T& b) {
  if constexpr (NumberTraits<T>::order == 0) {
    return select(m, a, b);
  } else {
    T r;
    r.v = select(m, a.v, b.v);
    for (int i = 0; i < 3; ++i) r.d[i] = select(m, a.d[i], b.d[i]);
    if constexpr (NumberTraits<T>::order == 2)
      for (int k = 0; k < 6; ++k) r.h[k] = select(m, a.h[k], b.h[k]);
    return r;
  }
}

// Arithmetic of Dual and Dual2; Number is either.
template <class T>
concept Number = NumberTraits<T>::order >
0;

template <Number T>
HWY_INLINE T operator+(const T& a, const T& b) {
  T r;
  r.v = a.v + b.v;
  for (int i = 0; i < 3; ++i) r.d[i] = a.d[i] + b.d[i];
  if constexpr (NumberTraits<T>::order == 2)
    for (int k = 0; k < 6; ++k) r.h[k] = a.h[k] + b.h[k];
  return r;
}
template <Number T>
HWY_INLINE T operator-(const T& a, const T& b) {
  T r;
  r.v = a.v - b.v;
  for (int i = 0; i < 3; ++i) r.d[i] = a.d[i] - b.d[i];
  if constexpr (NumberTraits<T>::order == 2)
    for (int k = 0; k < 6; ++k) r.h[k] = a.h[k] - b.h[k];
  return r;
}
template <Number T>
HWY_INLINE T operator*(const T& a, const T& b) {
  return chain(a, b, a.v * b.v, b.v, a.v, 0.0, 1.0, 0.0);
}
template <Number T>
HWY_INLINE T operator/(const T& a, const T& b) {
  using L = LaneOf<T>;
  const L i = L(1.0) / b.v, q = a.v * i;
  return chain(a, b, q, i, -(q * i), L(0.0), -(i * i), L(2.0) * (q * (i * i)));
}
template <Number T>
HWY_INLINE T operator-(const T& a) {
  return chain(a, -a.v, LaneOf<T>(-1.0));
}
// With a factor or summand that does not depend on the point.
template <Number T>
HWY_INLINE T operator+(const T& a, double b) {
  T r = a;
  r.v = a.v + LaneOf<T>(b);
  return r;
}
template <Number T>
HWY_INLINE T operator+(double a, const T& b) {
  return b + a;
}
template <Number T>
HWY_INLINE T operator-(const T& a, double b) {
  return a + (-b);
}
template <Number T>
HWY_INLINE T operator-(double a, const T& b) {
  return (-b) + a;
}
template <Number T>
HWY_INLINE T operator*(const T& a, double b) {
  return chain(a, a.v * LaneOf<T>(b), LaneOf<T>(b));
}
template <Number T>
HWY_INLINE T operator*(double a, const T& b) {
  return b * a;
}
template <Number T>
HWY_INLINE T operator/(const T& a, double b) {
  return a * (1.0 / b);
}

// ---- Functions of any number ------------------------------------------------------------------------

/// x times a factor that counts as constant (its derivatives are not taken).
template <class T>
HWY_INLINE T scaled(const T& x, LaneOf<T> factor) {
  return chain(x, value_of(x) * factor, factor);
}
/// |x|; derivative sign(x), 0 at 0.
template <class T>
HWY_INLINE T absolute(const T& x) {
  const auto v = value_of(x);
  return chain(x, lane::abs(v), lane::sign(v));
}
/// sqrt(x), x >= 0; derivatives 0 at x <= 1e-150, before the second one overflows.
template <class T>
HWY_INLINE T root(const T& x) {
  using L = LaneOf<T>;
  const L v = value_of(x), f = lane::sqrt(v);
  if constexpr (NumberTraits<T>::order == 0) {
    return f;
  } else {
    const auto regular = v > L(1e-150);
    const L i = L(1.0) / select(regular, v, L(1.0)), f1 = select(regular, L(0.5) * (f * i), L(0.0));
    return chain(x, f, f1, L(-0.5) * (f1 * i));
  }
}
template <class T>
HWY_INLINE T square(const T& x) {
  const auto v = value_of(x);
  return chain(x, v * v, v + v, LaneOf<T>(2.0));
}
/// The smaller, the larger; the first argument on ties.
template <class T>
HWY_INLINE T smaller(const T& a, const T& b) {
  return choose<T>(value_of(b) < value_of(a), b, a);
}
template <class T>
HWY_INLINE T larger(const T& a, const T& b) {
  return choose<T>(value_of(b) > value_of(a), b, a);
}
template <class T>
HWY_INLINE T exponential(const T& x) {
  const auto f = lane::exp(value_of(x));
  return chain(x, f, f, f);
}
/// ln x, x > 0.
template <class T>
HWY_INLINE T logarithm(const T& x) {
  using L = LaneOf<T>;
  const L v = value_of(x), i = L(1.0) / v;
  return chain(x, lane::log(v), i, -(i * i));
}
/// (cos x, sin x) are separate calls; |x| < 3e4.
template <class T>
HWY_INLINE T cosine(const T& x) {
  const auto c = lane::cos(value_of(x)), s = lane::sin(value_of(x));
  return chain(x, c, -s, -c);
}
template <class T>
HWY_INLINE T sine(const T& x) {
  const auto c = lane::cos(value_of(x)), s = lane::sin(value_of(x));
  return chain(x, s, c, -s);
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
/// x^n for lanes, x >= 0 (0 for x = 0, also when the result underflows).
template <class L>
HWY_INLINE L lane_power(L x, const Power& n) {
  switch (n.kind) {
    case Power::Kind::integer:
      return integer_power(x, n.integer);
    case Power::Kind::square_root:
      return lane::sqrt(x);
    default: {
      const L floor = 1e-300;
      return select(x > floor, lane::exp(L(n.exponent) * lane::log(lane::max(x, floor))), L(0.0));
    }
  }
}
/// x^n, x >= 0, n > 0; derivatives at x <= 1e-150 (1e-75 for n < 1, where they are steepest) are 0, but for
/// n = 1.
template <class T>
HWY_INLINE T power(const T& x, const Power& n) {
  using L = LaneOf<T>;
  if (n.exponent == 1.0) return x;
  const L v = value_of(x), f = lane_power(v, n);
  if constexpr (NumberTraits<T>::order == 0) {
    return f;
  } else {
    const auto regular = v > L(n.exponent < 1.0 ? 1e-75 : 1e-150);
    const L i = L(1.0) / select(regular, v, L(1.0));
    const L f1 = select(regular, L(n.exponent) * (f * i), L(0.0));
    return chain(x, f, f1, L(n.exponent - 1.0) * (f1 * i));
  }
}

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // once per instruction set
