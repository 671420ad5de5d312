// The displacement form of the super-elliptic blend; equations are those of function_rockwood.hpp.
#if defined(BLENDWRIGHT_FUNCTION_DISPLACEMENT_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BLENDWRIGHT_FUNCTION_DISPLACEMENT_INL_HPP
#undef BLENDWRIGHT_FUNCTION_DISPLACEMENT_INL_HPP
#else
#define BLENDWRIGHT_FUNCTION_DISPLACEMENT_INL_HPP
#endif

#include "implicit/number/number-inl.hpp"
#include "implicit/operators/function_rockwood.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// Below this x_i counts as 0: its powers would make derivatives infinite.
inline constexpr double least_x = 1e-150;

/// x_i, x_i^w and T_i at a depth t, with d_i = a_i - min a.
template <class L>
struct Term {
  L x, power, weight;
  HWY_INLINE Term(const SuperEllipse& b, std::size_t i, L d, L t) {
    x = lane::max(L(0.0), L(1.0) - (d + t) * L(b.inverse_r[i]));
    power = ratio_power(x, b.w);
    const auto counts = x > L(least_x);
    weight = select(counts, power / select(counts, x, L(1.0)) * L(b.inverse_r[i]), L(0.0));
  }
};

/// The t >= 0 of (2). terms.offset(i) = d_i. Each lane stops by itself, so that its bits are its own.
template <class L, class Terms>
HWY_INLINE L depth(const SuperEllipse& b, const Terms& terms) {
  const std::size_t k = b.r.size();
  L t = 0.0;
  auto active = t >= L(0.0);
  for (int step = 0; step < 100 && any(active); ++step) {
    L sum = 0.0, slope = 0.0;
    for (std::size_t i = 0; i < k; ++i) {
      const Term<L> at(b, i, terms.offset(i), t);
      sum = sum + at.power;
      slope = slope + at.weight;
    }
    // The norm N = sum^(1/w) falls by N/sum slope.
    const L norm = lane_power(sum, b.inverse_w), down = (norm - L(1.0)) * sum / (norm * slope);
    active = active && down > L(0.0);
    t = select(active, t + down, t);
    active = active && down > L(std::numeric_limits<double>::epsilon()) * t;
  }
  return t;
}

/// The result with the value `value`, from the arguments terms.number(i) with their derivatives: (3).
template <class T, class Terms>
HWY_INLINE T displaced(const SuperEllipse& b, const Terms& terms, LaneOf<T> t, LaneOf<T> value) {
  using L = LaneOf<T>;
  if constexpr (NumberTraits<T>::order == 0) {
    return value;
  } else {
    const std::size_t k = b.r.size();
    L all = 0.0;
    for (std::size_t i = 0; i < k; ++i) all = all + Term<L>(b, i, terms.offset(i), t).weight;
    T h = constant<T>(value);
    for (std::size_t i = 0; i < k; ++i) {
      const L share = Term<L>(b, i, terms.offset(i), t).weight / all;
      const T a = terms.number(i);
      for (int c = 0; c < 3; ++c) h.d[c] = multiply_add(share, a.d[c], h.d[c]);
      if constexpr (NumberTraits<T>::order == 2)
        for (int c = 0; c < 6; ++c) h.h[c] = multiply_add(share, a.h[c], h.h[c]);
    }
    if constexpr (NumberTraits<T>::order == 2) {
      if (b.w.exponent == 1.0) return h;
      for (std::size_t i = 0; i < k; ++i) {
        const Term<L> at(b, i, terms.offset(i), t);
        const auto counts = at.x > L(least_x);
        const L bend = select(
            counts,
            L((b.w.exponent - 1.0) * b.inverse_r[i]) * at.weight / (select(counts, at.x, L(1.0)) * all),
            L(0.0));
        const T a = terms.number(i);
        L off[3];
        for (int c = 0; c < 3; ++c) off[c] = a.d[c] - h.d[c];
        for (int c = 0; c < 6; ++c) h.h[c] = h.h[c] - bend * (off[hessian_row[c]] * off[hessian_column[c]]);
      }
    }
    return h;
  }
}

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // once per instruction set
