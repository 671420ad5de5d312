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

/// What a length is divided by while it is summed: its largest term m, kept in [1e-60, the largest number].
/// The inverse and its square are numbers, so that no derivative overflows; terms that are all below 1e-60
/// are the origin to 1e-60.
template <class L>
HWY_INLINE L norm_scale(L m) {
  return lane::min(lane::max(m, L(1e-60)), L(std::numeric_limits<double>::max()));
}

// The p-norm N_n(u) = (sum |u_i|^n)^(1/n), n > 0, with a scale c and r_i = |u_i| / c:
//   N = c S^(1/n),  S = sum r_i^n (1) N_i = sign(u_i) r_i^(n-1) q,  q = S^(1/n) / S (2) N_ij = (n - 1)
//   (delta_ij q r_i^(n-2) / c - N_i N_j / N)                                                (3)
// For integers n, c is the power of two below m = max |u_i|: no division, and S lies in [1, k 2^64]. For
// other n, c = m, so that the largest power is 1 without being computed, and S lies in [1, k]. Nothing
// overflows. Derivatives are 0 where all terms are below 1e-60 (the origin) or the norm is infinite; for real
// n those of a term with r_i below norm_floor, where (2) or (3) may be infinite, are left out. For n = 1,
// sign(0) = 0. Terms that are all below the least normal number may count as 0.

/// The least r_i that (2) and (3) are used for when n is real: r_i^(n-2) / c stays a number.
HWY_INLINE double norm_floor(const Power& n) { return n.exponent < 1.0 ? 1e-75 : 1e-150; }

/// c and 1/c.
template <class L>
struct NormScale {
  L scale, inverse;
  HWY_INLINE NormScale(L m, const Power& n) {
    if (n.kind == Power::Kind::integer) {
      scale = lane::power_of_two_below(lane::min(lane::max(m, L(0x1p-1022)), L(0x1p1022)));
      inverse = lane::inverse_power_of_two(scale);
    } else {
      scale = m;
      inverse = L(1.0) / select(m >= L(std::numeric_limits<double>::min()), m, L(1.0));
    }
  }
};

/// q times the sum of the parts of (2) and (3) that belong to single terms.
template <class T>
struct NormDerivatives {
  LaneOf<T> d[3]{}, h[6]{};
  HWY_INLINE NormDerivatives() = default;

  /// f = r^n.
  HWY_INLINE void add(const T& u, LaneOf<T> f, const Power& n, LaneOf<T> inverse) {
    using L = LaneOf<T>;
    const L v = value_of(u), r = lane::abs(v) * inverse;
    L g, g2;  // r^(n-1), r^(n-2)
    if (n.kind == Power::Kind::integer) {
      g2 = n.integer == 2 ? L(1.0) : integer_power(r, n.integer - 2);
      g = g2 * r;
    } else {
      const auto regular = r > L(norm_floor(n));
      const L i = L(1.0) / select(regular, r, L(1.0));
      g = select(regular, f * i, L(0.0));
      g2 = g * i;
    }
    const L first = select(v < L(0.0), -g, g), second = L(n.exponent - 1.0) * inverse * g2;
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

  /// The norm c root, root = S^(1/n).
  [[nodiscard]] HWY_INLINE T finish(LaneOf<T> m, const NormScale<LaneOf<T>>& c, LaneOf<T> sum, LaneOf<T> root,
                                    const Power& n) const {
    using L = LaneOf<T>;
    T norm;
    norm.v = c.scale * root;
    const auto regular = m > L(1e-60) && norm.v <= L(std::numeric_limits<double>::max());
    const L q = root / sum;
    HWY_UNROLL(8)
    for (int k = 0; k < 3; ++k) norm.d[k] = select(regular, q * d[k], L(0.0));
    if constexpr (NumberTraits<T>::order == 2) {
      const L bend = L(1.0 - n.exponent) * c.inverse / root;
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

/// r^n, r = u / c; for real n, where r <= 1: 1 where both are infinite.
template <class L>
HWY_INLINE L norm_term(L u, L inverse, const Power& n) {
  if (n.kind == Power::Kind::integer) return integer_power(u * inverse, n.integer);
  return ratio_power(lane::min(L(1.0), u * inverse), n);
}

/// f_i = r_i^n of K lanes u_i >= 0, and their sum S. For real n two or three are put in order first, because
/// the power of the largest is 1.
template <class L, std::size_t K>
HWY_INLINE L norm_sum(const L (&u)[K], L m, L inverse, const Power& n, L (&f)[K]) {
  if (n.kind != Power::Kind::integer) {
    if constexpr (K == 2) {
      const auto first = u[0] >= u[1];
      const L p = norm_term(select(first, u[1], u[0]), inverse, n);
      f[0] = select(first, L(1.0), p);
      f[1] = select(first, p, L(1.0));
      return L(1.0) + p;
    }
    if constexpr (K == 3) {
      const L small = lane::min(u[0], u[1]), large = lane::max(u[0], u[1]);
      const L least = lane::min(small, u[2]), middle = lane::max(small, lane::min(large, u[2]));
      const L p = norm_term(least, inverse, n), q = norm_term(middle, inverse, n);
      HWY_UNROLL(8)
      for (std::size_t i = 0; i < K; ++i) f[i] = select(u[i] == m, L(1.0), select(u[i] == least, p, q));
      return L(1.0) + (p + q);
    }
  }
  L sum = 0.0;
  HWY_UNROLL(8)
  for (std::size_t i = 0; i < K; ++i) {
    f[i] = norm_term(u[i], inverse, n);
    sum = sum + f[i];
  }
  return sum;
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
  const NormScale<L> c(m, n);
  const L sum = norm_sum(a, m, c.inverse, n, f), root = lane_power(sum, inverse_n);
  if constexpr (NumberTraits<T>::order == 0) {
    return c.scale * root;
  } else {
    NormDerivatives<T> terms;
    HWY_UNROLL(8)
    for (std::size_t i = 0; i < K; ++i) terms.add(u[i], f[i], n, c.inverse);
    return terms.finish(m, c, sum, root, n);
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
  const NormScale<L> c(m, n);
  L sum = 0.0;
  [[maybe_unused]] NormDerivatives<T> derivatives;
  for (std::size_t i = 0; i < k; ++i) {
    const T u = terms(i);
    const L f = norm_term(lane::abs(value_of(u)), c.inverse, n);
    sum = sum + f;
    if constexpr (NumberTraits<T>::order > 0) derivatives.add(u, f, n, c.inverse);
  }
  const L root = lane_power(sum, inverse_n);
  if constexpr (NumberTraits<T>::order == 0) {
    return c.scale * root;
  } else {
    return derivatives.finish(m, c, sum, root, n);
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
