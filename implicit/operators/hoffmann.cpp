#include "implicit/operators/hoffmann.hpp"

#include <algorithm>

#include "implicit/number/targets.hpp"
#include "implicit/operators/function_bounds.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/hoffmann.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/operators/arc-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const HoffmannPolynomial& b, const Inputs<T>& in) {
  const T y1 = in.arg(0), y2 = in.arg(1);
  const double w = b.r1 * b.r2 - b.p;
  return square(y1 * b.r2 + y2 * b.r1 - T(b.r1 * b.r2)) - y1 * y2 * (2.0 * w);
}

template <class T>
HWY_INLINE T evaluate(const HoffmannBlend& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T x1 = in.arg(0) * argument_sign(b.role, 0), x2 = in.arg(1) * argument_sign(b.role, 1);
  const L v1 = value_of(x1), v2 = value_of(x2), zero = 0.0;
  const auto blended = v1 - v2 < L(b.r1) && v2 - v1 < L(b.r2);  // false for two infinite arguments
  const auto first = v1 <= v2;                                  // is the smaller
  const L d = select(blended, lane::abs(v1 - v2), zero);
  const L r_near = select(first, L(b.r1), L(b.r2)), r_far = select(first, L(b.r2), L(b.r1));
  const Arc<L> at = arc(b.r1 + b.r2, b.w, d, r_near * (r_far - d));
  const L far = d + at.t, y1 = select(first, at.t, far), y2 = select(first, far, at.t);
  const ArcGradient<L> g = arc_gradient(b, y1, y2, at.q);
  const L i = L(1.0) / (g.g1 + g.g2), bend = -(((g.k * i) * i) * i);
  const T blend = chain(x1, x2, lane::min(v1, v2) - at.t, g.g1 * i, g.g2 * i, bend, -bend, bend);
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

HoffmannBlend::HoffmannBlend(double r1_, double r2_, double p, ZeroRole role_)
    : r1(r1_), r2(r2_), role(role_), w(std::fma(r1, r2, -p)) {}

/// Term by term: it is not monotone, and no scene uses it.
static Range polynomial_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const HoffmannPolynomial*>(body);
  const double y1 = std::max(std::abs(args[0].lo), std::abs(args[0].hi)), u = b.r2 * b.r2;
  const double y2 = std::max(std::abs(args[1].lo), std::abs(args[1].hi)), v = b.r1 * b.r1;
  const double most =
      u * (y1 + b.r1) * (y1 + b.r1) + v * y2 * (y2 + 2.0 * b.r2) + 2.0 * std::abs(b.p) * y1 * y2;
  return spread({-most, most}, range_slack);
}

/// The values lie around zero: what rounding adds is measured by the arguments and the radii.
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

/// The union is concave, K <= 0; intersection and difference are convex.
static LinearBound blend_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const HoffmannBlend*>(body);
  const Bend bend = b.role == ZeroRole::make_union ? Bend::concave : Bend::convex;
  return tangent_bound(op_for<HoffmannBlend>(), body, in, bend,
                       2.0 * range_slack * (b.r1 + b.r2 + size_of(in.ranges)));
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
  static const Op op{"hoffmann_blend",
                     HWY_DYNAMIC_DISPATCH(hoffmann_blend_simd)(),
                     HWY_STATIC_DISPATCH(hoffmann_blend_scalar)(),
                     blend_range,
                     blend_shortcut,
                     blend_linear};
  return op;
}

}  // namespace blendwright
#endif
