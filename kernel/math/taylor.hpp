#pragma once
// Truncated Taylor arithmetic: the one way exact derivatives are made in this library.
//
// Taylor<N>   series in one variable:   f(v0 + h) = sum_k c[k] h^k,            k <= N
// Taylor2<N>  series in two variables:  f(u0 + g, v0 + h) = sum c(i,j) g^i h^j, i + j <= N
//
// Coefficients are normalised: c[k] = f^(k)/k!, c(i,j) = f_{u^i v^j}/(i! j!). A formula is written once as a
// template over its number type and evaluated with double, Taylor or Taylor2. Cost of a product: O(N^2),
// O(N^4).
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <utility>

namespace blendwright {

template <int N>
struct Taylor {
  static constexpr int order = N;
  std::array<double, N + 1> c{};
  constexpr Taylor() = default;
  constexpr Taylor(double x) { c[0] = x; }  // NOLINT: constants mix freely with series
  [[nodiscard]] static constexpr Taylor variable(double x) {
    Taylor t(x);
    if constexpr (N > 0) t.c[1] = 1.0;
    return t;
  }
  [[nodiscard]] constexpr double value() const { return c[0]; }
  [[nodiscard]] constexpr double derivative(int k) const {
    double f = 1.0;
    for (int i = 2; i <= k; ++i) f *= i;
    return c[static_cast<std::size_t>(k)] * f;
  }
  /// d/dh of the series; the top coefficient of the result is not known and set to 0.
  [[nodiscard]] constexpr Taylor differentiated() const {
    Taylor t;
    for (std::size_t k = 0; k < N; ++k) t.c[k] = static_cast<double>(k + 1) * c[k + 1];
    return t;
  }
  friend constexpr Taylor operator*(const Taylor& a, const Taylor& b) {
    Taylor r;
    for (std::size_t i = 0; i <= N; ++i)
      for (std::size_t j = 0; i + j <= N; ++j) r.c[i + j] += a.c[i] * b.c[j];
    return r;
  }
};

/// Place of the coefficient of g^i h^j: ordered by total degree, then by j.
constexpr std::size_t taylor2_index(int i, int j) {
  return static_cast<std::size_t>((i + j) * (i + j + 1) / 2 + j);
}

/// Every product of two coefficients that stays within the order N: places in a, in b, in the result.
template <int N>
inline constexpr auto taylor2_terms = [] {
  std::array<std::array<std::size_t, 3>, (N + 1) * (N + 2) * (N + 3) * (N + 4) / 24> t{};
  std::size_t k = 0;
  for (int da = 0; da <= N; ++da)
    for (int ja = 0; ja <= da; ++ja)
      for (int db = 0; da + db <= N; ++db)
        for (int jb = 0; jb <= db; ++jb)
          t[k++] = {taylor2_index(da - ja, ja), taylor2_index(db - jb, jb),
                    taylor2_index(da - ja + db - jb, ja + jb)};
  return t;
}();

template <int N>
struct Taylor2 {
  static constexpr int order = N;
  static constexpr std::size_t size = (N + 1) * (N + 2) / 2;
  std::array<double, size> c{};  ///< ordered by total degree, then by j: index(i, j)
  [[nodiscard]] static constexpr std::size_t index(int i, int j) { return taylor2_index(i, j); }
  constexpr Taylor2() = default;
  constexpr Taylor2(double x) { c[0] = x; }  // NOLINT: constants mix freely with series
  [[nodiscard]] static constexpr Taylor2 u_variable(double x) {
    Taylor2 t(x);
    if constexpr (N > 0) t.c[1] = 1.0;
    return t;
  }
  [[nodiscard]] static constexpr Taylor2 v_variable(double x) {
    Taylor2 t(x);
    if constexpr (N > 0) t.c[2] = 1.0;
    return t;
  }
  [[nodiscard]] constexpr double value() const { return c[0]; }
  [[nodiscard]] constexpr double derivative(int i, int j) const {
    double f = 1.0;
    for (int k = 2; k <= i; ++k) f *= k;
    for (int k = 2; k <= j; ++k) f *= k;
    return c[index(i, j)] * f;
  }
  friend constexpr Taylor2 operator*(const Taylor2& a, const Taylor2& b) {
    Taylor2 r;
    if constexpr (N == 2) {  // written out: the product inside every jet
      r.c[0] = a.c[0] * b.c[0];
      r.c[1] = a.c[0] * b.c[1] + a.c[1] * b.c[0];
      r.c[2] = a.c[0] * b.c[2] + a.c[2] * b.c[0];
      r.c[3] = a.c[0] * b.c[3] + a.c[1] * b.c[1] + a.c[3] * b.c[0];
      r.c[4] = a.c[0] * b.c[4] + a.c[1] * b.c[2] + a.c[2] * b.c[1] + a.c[4] * b.c[0];
      r.c[5] = a.c[0] * b.c[5] + a.c[2] * b.c[2] + a.c[5] * b.c[0];
    } else {
      [&]<std::size_t... k>(
          std::index_sequence<k...>) {  // straight-line code: three times as fast as the loops
        ((r.c[taylor2_terms<N>[k][2]] += a.c[taylor2_terms<N>[k][0]] * b.c[taylor2_terms<N>[k][1]]), ...);
      }
      (std::make_index_sequence<taylor2_terms<N>.size()>{});
    }
    return r;
  }
};

template <class T>
concept TaylorSeries = requires(const T& t) {
  T::order;
  t.c;
  { t.value() } -> std::convertible_to<double>;
};

template <TaylorSeries T>
constexpr T operator+(T a, const T& b) {
  for (std::size_t k = 0; k < a.c.size(); ++k) a.c[k] += b.c[k];
  return a;
}
template <TaylorSeries T>
constexpr T operator-(T a, const T& b) {
  for (std::size_t k = 0; k < a.c.size(); ++k) a.c[k] -= b.c[k];
  return a;
}
template <TaylorSeries T>
constexpr T operator-(T a) {
  for (double& x : a.c) x = -x;
  return a;
}
template <TaylorSeries T>
constexpr T operator+(T a, double b) {
  a.c[0] += b;
  return a;
}
template <TaylorSeries T>
constexpr T operator+(double a, T b) {
  b.c[0] += a;
  return b;
}
template <TaylorSeries T>
constexpr T operator-(T a, double b) {
  a.c[0] -= b;
  return a;
}
template <TaylorSeries T>
constexpr T operator-(double a, const T& b) {
  return a + (-b);
}
template <TaylorSeries T>
constexpr T operator*(T a, double b) {
  for (double& x : a.c) x *= b;
  return a;
}
template <TaylorSeries T>
constexpr T operator*(double a, T b) {
  return b * a;
}

/// a b that takes 0 * infinity as 0 for a coefficient 0 of a.
template <int N>
constexpr Taylor<N> sparse_product(const Taylor<N>& a, const Taylor<N>& b) {
  Taylor<N> r;
  for (std::size_t i = 0; i <= N; ++i)
    for (std::size_t j = 0; a.c[i] != 0.0 && i + j <= N; ++j)
      if (b.c[j] != 0.0) r.c[i + j] += a.c[i] * b.c[j];
  return r;
}
template <int N>
constexpr Taylor2<N> sparse_product(const Taylor2<N>& a, const Taylor2<N>& b) {
  Taylor2<N> r;
  for (int da = 0; da <= N; ++da)
    for (int ja = 0; ja <= da; ++ja) {
      const double x = a.c[a.index(da - ja, ja)];
      for (int db = 0; x != 0.0 && da + db <= N; ++db)
        for (int jb = 0; jb <= db; ++jb) {
          const double y = b.c[b.index(db - jb, jb)];
          if (y != 0.0) r.c[r.index(da - ja + db - jb, ja + jb)] += x * y;
        }
    }
  return r;
}

/// True when a = a0 + one variable, whose coefficient has the index `which`.
template <TaylorSeries T>
constexpr bool is_variable(const T& a, std::size_t which) {
  for (std::size_t k = 1; k < a.c.size(); ++k)
    if (a.c[k] != (k == which ? 1.0 : 0.0)) return false;
  return true;
}
template <TaylorSeries T, class Index>
constexpr T of_variable(const std::array<double, T::order + 1>& f, Index index) {
  T r;
  for (int k = 0; k <= T::order; ++k) r.c[index(k)] = f[static_cast<std::size_t>(k)];
  return r;
}

/// f(a) for a series a, given the derivatives f^(k)(a0)/k! in `f` (k = 0..N): Horner in the nilpotent part of
/// a. Where f has an infinite derivative (a^1.5 at a0 = 0), only the coefficients that it enters are infinite
/// or NaN.
template <TaylorSeries T>
constexpr T compose_scalar(const std::array<double, T::order + 1>& f, T a) {
  if constexpr (requires { T::index(0, 0); }) {  // f(u) and f(v) of a bare variable are read off
    if (is_variable(a, 1)) return of_variable<T>(f, [](int k) { return T::index(k, 0); });
    if (is_variable(a, 2)) return of_variable<T>(f, [](int k) { return T::index(0, k); });
  }
  a.c[0] = 0.0;
  T r(f[T::order]);
  const bool finite = f[T::order] - f[T::order] == 0.0;
  for (int k = T::order - 1; k >= 0; --k) {
    r = finite ? a * r : sparse_product(a, r);
    r.c[0] = f[static_cast<std::size_t>(k)];
  }
  return r;
}

template <TaylorSeries T>
T reciprocal(const T& a) {
  std::array<double, T::order + 1> f{};
  f[0] = 1.0 / a.value();
  for (std::size_t k = 1; k < f.size(); ++k) f[k] = -f[k - 1] * f[0];
  return compose_scalar(f, a);
}
template <TaylorSeries T>
T operator/(const T& a, const T& b) {
  return a * reciprocal(b);
}
template <TaylorSeries T>
T operator/(T a, double b) {
  for (double& x : a.c) x /= b;
  return a;
}
template <TaylorSeries T>
T operator/(double a, const T& b) {
  return reciprocal(b) * a;
}

template <TaylorSeries T>
T exp(const T& a) {
  std::array<double, T::order + 1> f{};
  f[0] = std::exp(a.value());
  for (std::size_t k = 1; k < f.size(); ++k) f[k] = f[k - 1] / static_cast<double>(k);
  return compose_scalar(f, a);
}
template <TaylorSeries T>
T log(const T& a) {
  std::array<double, T::order + 1> f{};
  f[0] = std::log(a.value());
  double p = 1.0;
  for (std::size_t k = 1; k < f.size(); ++k) {
    p /= a.value();
    f[k] = (k % 2 == 1 ? p : -p) / static_cast<double>(k);
  }
  return compose_scalar(f, a);
}
/// a^p for a real exponent p; a > 0, or a >= 0 where p is not whole and positive (derivatives beyond p
/// infinite at 0), or any a where p is a whole number >= 0 (exact at a = 0 too), or any a != 0 where p is a
/// whole number < 0.
template <TaylorSeries T>
T pow(const T& a, double p) {
  std::array<double, T::order + 1> f{};
  double binomial = 1.0;
  for (std::size_t k = 0; k < f.size() && binomial != 0.0; ++k) {
    const double e = p - static_cast<double>(k);
    f[k] = binomial * std::pow(a.value(), e);
    binomial *= e / static_cast<double>(k + 1);
  }
  return compose_scalar(f, a);
}
/// a^b; with a constant series b, the rules of a constant exponent hold, else a > 0.
template <TaylorSeries T>
T pow(const T& a, const T& b) {
  for (std::size_t k = 1; k < b.c.size(); ++k)
    if (b.c[k] != 0.0) return exp(b * log(a));
  return pow(a, b.value());
}
template <TaylorSeries T>
T sqrt(const T& a) {
  std::array<double, T::order + 1> f{};
  f[0] = std::sqrt(a.value());
  for (std::size_t k = 1; k < f.size(); ++k)
    f[k] = k == 1 ? 0.5 / f[0]
                  : f[k - 1] * (1.5 - static_cast<double>(k)) / (static_cast<double>(k) * a.value());
  return compose_scalar(f, a);
}

/// Builds f from its first four derivatives repeating with sign: sin, cos (s = -1), sinh, cosh (s = +1).
template <TaylorSeries T>
T compose_periodic(double f0, double f1, double s, const T& a) {
  std::array<double, T::order + 1> f{};
  double factorial = 1.0;
  for (std::size_t k = 0; k < f.size(); ++k) {
    if (k > 0) factorial *= static_cast<double>(k);
    const double sign = (k / 2) % 2 == 1 ? s : 1.0;
    f[k] = sign * (k % 2 == 0 ? f0 : f1) / factorial;
  }
  return compose_scalar(f, a);
}
template <TaylorSeries T>
T sin(const T& a) {
  return compose_periodic(std::sin(a.value()), std::cos(a.value()), -1.0, a);
}
template <TaylorSeries T>
T cos(const T& a) {
  return compose_periodic(std::cos(a.value()), -std::sin(a.value()), -1.0, a);
}
template <TaylorSeries T>
T sinh(const T& a) {
  return compose_periodic(std::sinh(a.value()), std::cosh(a.value()), 1.0, a);
}
template <TaylorSeries T>
T cosh(const T& a) {
  return compose_periodic(std::cosh(a.value()), std::sinh(a.value()), 1.0, a);
}
/// {sin a, cos a} for the price of one.
template <TaylorSeries T>
std::array<T, 2> sin_cos(const T& a) {
  const double s = std::sin(a.value()), c = std::cos(a.value());
  return {compose_periodic(s, c, -1.0, a), compose_periodic(c, -s, -1.0, a)};
}
inline std::array<double, 2> sin_cos(double a) { return {std::sin(a), std::cos(a)}; }

/// f with f' = 1 + s f^2, given f(a0) and f'(a0): tan (s = +1), tanh (s = -1).
template <TaylorSeries T>
T compose_riccati(double f0, double f1, double s, const T& a) {
  std::array<double, T::order + 1> f{};
  f[0] = f0;
  for (std::size_t k = 0; k + 1 < f.size(); ++k) {
    double square = 0.0;  // coefficient k of f^2
    for (std::size_t i = 0; i <= k; ++i) square += f[i] * f[k - i];
    f[k + 1] = k == 0 ? f1 : s * square / static_cast<double>(k + 1);
  }
  return compose_scalar(f, a);
}
template <TaylorSeries T>
T tan(const T& a) {
  const double t = std::tan(a.value());
  return compose_riccati(t, 1.0 + t * t, 1.0, a);
}
template <TaylorSeries T>
T tanh(const T& a) {
  const double sech = 1.0 / std::cosh(a.value());  // 1 - tanh^2 would cancel
  return compose_riccati(std::tanh(a.value()), sech * sech, -1.0, a);
}
/// |a|; at a0 = 0 the branch of a0 > 0.
template <TaylorSeries T>
T abs(const T& a) {
  return a.value() < 0 ? -a : a;
}

template <TaylorSeries T>
T atan2(const T& y, const T& x) {
  // The angle of (x, y) is a0 + atan(t), with t the tangent of the angle turned back by the constant term a0.
  const double a0 = std::atan2(y.value(), x.value()), s = std::sin(a0), c = std::cos(a0);
  const T t = (y * c - x * s) / (x * c + y * s);
  std::array<double, T::order + 1> f{};  // atan t = t - t^3/3 + t^5/5 - ...
  for (std::size_t k = 1; k < f.size(); k += 2) f[k] = (k % 4 == 1 ? 1.0 : -1.0) / static_cast<double>(k);
  f[0] = a0;
  return compose_scalar(f, t);
}
template <TaylorSeries T>
T atan(const T& a) {
  return atan2(a, T(1.0));
}
template <TaylorSeries T>
T asin(const T& a) {
  return atan2(a, sqrt((1.0 - a) * (1.0 + a)));
}
template <TaylorSeries T>
T acos(const T& a) {
  return atan2(sqrt((1.0 - a) * (1.0 + a)), a);
}

}  // namespace blendwright
