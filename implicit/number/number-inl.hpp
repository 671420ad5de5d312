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

#include "implicit/number/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

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
  const L q = a.v / b.v, i = L(1.0) / b.v;  // the value is the one that lanes have
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
  return chain(a, a.v / LaneOf<T>(b), LaneOf<T>(1.0 / b));
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
