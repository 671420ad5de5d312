#include "implicit/operators/hoffmann.hpp"

#include <algorithm>

#include "implicit/number/targets.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/hoffmann.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// B_H and its first partials; the second ones are 2 r2^2, 2 p and 2 r1^2.
template <class L>
struct Conic {
  L value, d1, d2;
};
template <class L, class Body>
HWY_INLINE Conic<L> conic(const Body& b, L y1, L y2) {
  const L u = b.r2 * b.r2, v = b.r1 * b.r1, p = b.p;
  const L e1 = y1 - L(b.r1), e2 = y2 - L(b.r2);
  // r2^2 (y1 - r1)^2 + r1^2 y2 (y2 - 2 r2) + 2 p y1 y2
  const L value = u * (e1 * e1) + v * (y2 * (e2 - L(b.r2))) + L(2.0) * p * (y1 * y2);
  return {value, L(2.0) * (u * e1 + p * y2), L(2.0) * (v * e2 + p * y1)};
}

template <class T>
HWY_INLINE T evaluate(const HoffmannPolynomial& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T x = in.arg(0), y = in.arg(1);
  const Conic<L> c = conic<L>(b, value_of(x), value_of(y));
  return chain(x, y, c.value, c.d1, c.d2, L(2.0 * b.r2 * b.r2), L(2.0 * b.p), L(2.0 * b.r1 * b.r1));
}

template <class T>
HWY_INLINE T evaluate(const HoffmannBlend& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T x1 = in.arg(0) * argument_sign(b.role, 0), x2 = in.arg(1) * argument_sign(b.role, 1);
  const L v1 = value_of(x1), v2 = value_of(x2), zero = 0.0;
  const auto blended = v1 - v2 < L(b.r1) && v2 - v1 < L(b.r2);  // false for two infinite arguments
  const L y1 = select(blended, lane::max(v1 - v2, zero), zero);
  const L y2 = select(blended, lane::max(v2 - v1, zero), zero);
  const L a = b.r1 * b.r1 + b.r2 * b.r2 + 2.0 * b.p, c = conic<L>(b, y1, y2).value;
  const L half = L(b.r1 * b.r2 * (b.r1 + b.r2)) - L(b.r2 * b.r2 + b.p) * y1 - L(b.r1 * b.r1 + b.p) * y2;
  // (2 a h' + b)/2 = sqrt(b^2/4 - a c). With s = y1 - y2 and w = r1 r2 - p the discriminant is a sum of terms
  // that are not negative where -r2 <= s <= r1: w (w s^2 + 2 r1 r2 (r1 - s) (r2 + s)).
  const L s = y1 - y2, w = b.r1 * b.r2 - b.p;
  const L root = lane::sqrt(w * (w * (s * s) + L(2.0 * b.r1 * b.r2) * ((L(b.r1) - s) * (L(b.r2) + s))));
  const auto forward = half > zero;
  const L h = select(forward, -c, root - half) / select(forward, half + root, a);
  const Conic<L> at = conic<L>(b, y1 - h, y2 - h);
  const L i = L(-0.5) / root;  // 1/(B_1 + B_2)
  const L f1 = at.d1 * i, f2 = at.d2 * i;
  // Both derivatives of B_H(x1 - U, x2 - U) = 0: U_11 = U_22 = -U_12
  const L k =
      (L(2.0 * b.r2 * b.r2) * (f2 * f2) - L(4.0 * b.p) * (f1 * f2) + L(2.0 * b.r1 * b.r1) * (f1 * f1)) * i;
  const L least = lane::min(v1, v2);
  const T blend = chain(x1, x2, lane::min(least + h, least), f1, f2, k, -k, k);
  return choose<T>(blended, blend, smaller(x1, x2)) * result_sign(b.role);
}

KernelSet hoffmann_polynomial_simd() { return kernel_set<HoffmannPolynomial, Simd>(); }
KernelSet hoffmann_blend_simd() { return kernel_set<HoffmannBlend, Simd>(); }
#if HWY_ONCE
KernelSet hoffmann_polynomial_scalar() { return kernel_set<HoffmannPolynomial, double>(); }
KernelSet hoffmann_blend_scalar() { return kernel_set<HoffmannBlend, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(hoffmann_polynomial_simd);
HWY_EXPORT(hoffmann_blend_simd);

/// Term by term: it is not monotone, and no scene uses it.
static Range polynomial_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const HoffmannPolynomial*>(body);
  const double y1 = std::max(std::abs(args[0].lo), std::abs(args[0].hi)), u = b.r2 * b.r2;
  const double y2 = std::max(std::abs(args[1].lo), std::abs(args[1].hi)), v = b.r1 * b.r1;
  const double most =
      u * (y1 + b.r1) * (y1 + b.r1) + v * y2 * (y2 + 2.0 * b.r2) + 2.0 * std::abs(b.p) * y1 * y2;
  return spread({-most, most}, range_slack);
}

/// The values lie around zero: what rounding adds is measured by the radii. h' is a quotient of terms of
/// which the smallest, sqrt(D), is at least r (r1 r2 - p), r the smaller radius.
static Range blend_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const HoffmannBlend*>(body);
  const Range r = b.role == ZeroRole::make_difference
                      ? ends(op_for<HoffmannBlend>(), body, args, {true, false})
                      : ends(op_for<HoffmannBlend>(), body, args, {true});
  double size = b.r1 + b.r2;
  for (const Range& arg : args)
    for (const double x : {arg.lo, arg.hi})
      if (std::isfinite(x)) size = std::max(size, std::abs(x));
  return spread(r, 0.0, range_slack * size);
}

/// Where the arguments differ by a radius everywhere the result is one of them; a difference has the sign of
/// a subtracted one turned.
static Shortcut blend_shortcut(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const HoffmannBlend*>(body);
  const auto signed_range = [&](std::size_t i) {
    return argument_sign(b.role, i) > 0.0 ? args[i] : Range{-args[i].hi, -args[i].lo};
  };
  const Range x1 = signed_range(0), x2 = signed_range(1);
  if (x2.lo - x1.hi >= b.r2) return Shortcut::to_argument(0);
  if (x1.lo - x2.hi >= b.r1 && b.role != ZeroRole::make_difference) return Shortcut::to_argument(1);
  return {};
}

}  // namespace detail

template <>
const Op& op_for<detail::HoffmannPolynomial>() {
  using namespace detail;
  static const Op op{"hoffmann_polynomial", HWY_DYNAMIC_DISPATCH(hoffmann_polynomial_simd)(),
                     HWY_STATIC_DISPATCH(hoffmann_polynomial_scalar)(), polynomial_range};
  return op;
}
template <>
const Op& op_for<detail::HoffmannBlend>() {
  using namespace detail;
  static const Op op{"hoffmann_blend", HWY_DYNAMIC_DISPATCH(hoffmann_blend_simd)(),
                     HWY_STATIC_DISPATCH(hoffmann_blend_scalar)(), blend_range, blend_shortcut};
  return op;
}

}  // namespace blendwright
#endif
