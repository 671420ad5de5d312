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

// The p-norm N_n(u) = (sum |u_i|^n)^(1/n), n > 0, with m = max |u_i| and r_i = |u_i| / m:
//   N = m S^(1/n),  S = 1 + sum r_i^n over all terms but the largest                                      (1)
//   N_i = sign(u_i) (r_i m / N)^(n-1) = sign(u_i) r_i^(n-1) q,  q = S^(1/n) / S (2) N_ij = (n - 1) (delta_ij
//   q r_i^(n-2) / m - N_i N_j / N)                                                (3)
// S lies in [1, k], so nothing overflows, and the norm of one term is exactly its magnitude. Derivatives are
// 0 where all terms are below 1e-60 (the origin) or the norm is infinite. Those of a term with r_i below
// n_norm_floor, where (2) or (3) may be infinite, are left out; for n = 2 that is none. For n = 1, sign(0) =
// 0.

/// The least r_i that (2) and (3) are used for: r_i^(n-2) / m stays a number.
HWY_INLINE double n_norm_floor(const Power& n) { return n.exponent < 1.0 ? 1e-75 : 1e-150; }

/// q times the sum of the parts of (2) and (3) that belong to single terms.
template <class T>
struct NormDerivatives {
  LaneOf<T> d[3]{}, h[6]{};
  HWY_INLINE NormDerivatives() = default;

  /// f = r^n, r = |u| inverse.
  HWY_INLINE void add(const T& u, LaneOf<T> f, const Power& n, LaneOf<T> inverse) {
    using L = LaneOf<T>;
    const L v = value_of(u);
    L first, second = inverse;
    if (n.exponent == 2.0) {
      first = v * inverse;
    } else {
      const L r = lane::abs(v) * inverse;
      const auto regular = r > L(n_norm_floor(n));
      const L i = L(1.0) / select(regular, r, L(1.0));
      const L g = select(regular, f * i, L(0.0));
      first = select(v < L(0.0), -g, g);
      second = L(n.exponent - 1.0) * (g * i) * inverse;
    }
    HWY_UNROLL(8)
    for (int k = 0; k < 3; ++k) d[k] = multiply_add(first, u.d[k], d[k]);
    if constexpr (NumberTraits<T>::order == 2) {
      L s[3];
      HWY_UNROLL(8)
      for (int k = 0; k < 3; ++k) s[k] = second * u.d[k];
      HWY_UNROLL(8)
      for (int k = 0; k < 6; ++k)
        h[k] = multiply_add(s[hessian_row[k]], u.d[hessian_column[k]], multiply_add(first, u.h[k], h[k]));
    }
  }

  /// The norm m root, root = S^(1/n).
  [[nodiscard]] HWY_INLINE T finish(LaneOf<T> m, LaneOf<T> inverse, LaneOf<T> sum, LaneOf<T> root,
                                    const Power& n) const {
    using L = LaneOf<T>;
    T norm;
    norm.v = m * root;
    const auto regular = m > L(1e-60) && norm.v <= L(std::numeric_limits<double>::max());
    const L q = root / sum;
    HWY_UNROLL(8)
    for (int k = 0; k < 3; ++k) norm.d[k] = select(regular, q * d[k], L(0.0));
    if constexpr (NumberTraits<T>::order == 2) {
      const L bend = L(1.0 - n.exponent) * inverse / root;
      L s[3];
      HWY_UNROLL(8)
      for (int k = 0; k < 3; ++k) s[k] = bend * norm.d[k];
      HWY_UNROLL(8)
      for (int k = 0; k < 6; ++k)
        norm.h[k] =
            select(regular, multiply_add(s[hessian_row[k]], norm.d[hessian_column[k]], q * h[k]), L(0.0));
    }
    return norm;
  }
};

/// 1/m, or 1 where m is no normal number: then all r_i count as 0.
template <class L>
HWY_INLINE L norm_inverse(L m) {
  return L(1.0) / select(m >= L(std::numeric_limits<double>::min()), m, L(1.0));
}

/// r^n, r = u / m <= 1; 1 where both are infinite.
template <class L>
HWY_INLINE L norm_term(L u, L inverse, const Power& n) {
  return ratio_power(lane::min(L(1.0), u * inverse), n);
}

/// f_i = r_i^n of K lanes u_i >= 0, and their sum S. Two or three are put in order first, because
/// the power of the largest is 1.
template <class L, std::size_t K>
HWY_INLINE L norm_sum(const L (&u)[K], L m, L inverse, const Power& n, L (&f)[K]) {
  if constexpr (K == 2) {
    const auto first = u[0] >= u[1];
    const L p = norm_term(select(first, u[1], u[0]), inverse, n);
    f[0] = select(first, L(1.0), p);
    f[1] = select(first, p, L(1.0));
    return L(1.0) + p;
  } else if constexpr (K == 3) {
    const L small = lane::min(u[0], u[1]), large = lane::max(u[0], u[1]);
    const L least = lane::min(small, u[2]), middle = lane::max(small, lane::min(large, u[2]));
    const L p = norm_term(least, inverse, n), q = norm_term(middle, inverse, n);
    HWY_UNROLL(8)
    for (std::size_t i = 0; i < K; ++i) f[i] = select(u[i] == m, L(1.0), select(u[i] == least, p, q));
    return L(1.0) + (p + q);
  } else {
    L sum = 0.0;
    HWY_UNROLL(8)
    for (std::size_t i = 0; i < K; ++i) {
      f[i] = select(u[i] == m, L(1.0), norm_term(u[i], inverse, n));
      sum = sum + f[i];
    }
    return sum;
  }
}

/// N_n(u_1, ..., u_K); terms of either sign count with their magnitudes.
template <class T, std::size_t K>
HWY_INLINE T p_norm(const T (&u)[K], const Power& n, const Power& inverse_n) {
  using L = LaneOf<T>;
  if (n.exponent == 1.0) {
    T sum = absolute(u[0]);
    HWY_UNROLL(8)
    for (std::size_t i = 1; i < K; ++i) sum = sum + absolute(u[i]);
    return sum;
  }
  L a[K], f[K];
  HWY_UNROLL(8)
  for (std::size_t i = 0; i < K; ++i) a[i] = lane::abs(value_of(u[i]));
  L m = a[0];
  HWY_UNROLL(8)
  for (std::size_t i = 1; i < K; ++i) m = lane::max(m, a[i]);
  const L inverse = norm_inverse(m), sum = norm_sum(a, m, inverse, n, f), root = lane_power(sum, inverse_n);
  if constexpr (NumberTraits<T>::order == 0) {
    return m * root;
  } else {
    NormDerivatives<T> terms;
    HWY_UNROLL(8)
    for (std::size_t i = 0; i < K; ++i) terms.add(u[i], f[i], n, inverse);
    return terms.finish(m, inverse, sum, root, n);
  }
}

/// The same of k >= 1 terms u_i = terms(i) that are computed where they are needed, twice.
template <class T, class Terms>
HWY_INLINE T p_norm_of(const Terms& terms, std::size_t k, const Power& n, const Power& inverse_n) {
  using L = LaneOf<T>;
  if (n.exponent == 1.0) {
    T sum = absolute(terms(0));
    for (std::size_t i = 1; i < k; ++i) sum = sum + absolute(terms(i));
    return sum;
  }
  L m = lane::abs(value_of(terms(0)));
  for (std::size_t i = 1; i < k; ++i) m = lane::max(m, lane::abs(value_of(terms(i))));
  const L inverse = norm_inverse(m);
  L sum = 0.0;
  [[maybe_unused]] NormDerivatives<T> derivatives;
  for (std::size_t i = 0; i < k; ++i) {
    const T u = terms(i);
    const L a = lane::abs(value_of(u));
    const L f = select(a == m, L(1.0), norm_term(a, inverse, n));
    sum = sum + f;
    if constexpr (NumberTraits<T>::order > 0) derivatives.add(u, f, n, inverse);
  }
  const L root = lane_power(sum, inverse_n);
  if constexpr (NumberTraits<T>::order == 0) {
    return m * root;
  } else {
    return derivatives.finish(m, inverse, sum, root, n);
  }
}

/// |x| = (sum x_i^2)^(1/2) of coordinates of either sign, overflow-safe in the same way; derivatives 0 at 0.
template <class T, std::size_t K>
HWY_INLINE T length(const T (&x)[K]) {
  using L = LaneOf<T>;
  L m = lane::abs(value_of(x[0]));
  HWY_UNROLL(8)
  for (std::size_t i = 1; i < K; ++i) m = lane::max(m, lane::abs(value_of(x[i])));
  const L scale = norm_scale(m), inverse = L(1.0) / scale;
  T sum = square(scaled(x[0], inverse));
  HWY_UNROLL(8)
  for (std::size_t i = 1; i < K; ++i) sum = sum + square(scaled(x[i], inverse));
  return scaled(root(sum), scale);
}

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // once per instruction set
