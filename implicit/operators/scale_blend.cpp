#include "implicit/operators/scale_blend.hpp"

#include <algorithm>

#include "implicit/number/targets.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/scale_blend.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// Squares of what is blended stay numbers.
inline constexpr double largest_blended = 1e100;

template <class T>
HWY_INLINE T evaluate(const ScaleBlend& s, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T x1 = in.arg(0), x2 = in.arg(1);
  const L v1 = value_of(x1), v2 = value_of(x2), zero = 0.0;
  const bool lower = s.side == ScaleSide::lower;
  const double k = lower ? 1.0 : -1.0;
  const auto ordinary = lane::max(v1, v2) > L(negligible) && lane::max(v1, v2) < L(largest_blended);
  const L line1 = L(s.k1) * v2, line2 = L(s.k2) * v1;
  const auto blended = (lower ? (v1 < line1 && v2 < line2) : (v1 > line1 && v2 > line2)) && ordinary &&
                       lane::min(v1, v2) > zero;

  const double w = s.r1 * s.r2 - s.p, u = s.r2 * s.r2, v = s.r1 * s.r1;
  const L difference = v1 - v2;
  const L root = lane::sqrt(
      L(w) * (L(w) * (difference * difference) + L(2.0 * s.r1 * s.r2) * ((v1 - line1) * (v2 - line2))));
  const L half = L(-k) * (L(s.b1) * v1 + L(s.b2) * v2);  // k b/2
  const L c = L(v) * (v2 * v2) + L(u) * (v1 * v1) + L(2.0 * s.p) * (v1 * v2);
  const auto forward = half > zero;
  const L h = L(k) * (select(forward, -c, root - half) / select(forward, root + half, L(s.a)));
  // k (2 a h + b)/2 = root; derivatives of a h^2 + b h + c = 0
  const L i = L(-k) / root;
  const L h1 = i * (L(u) * ((v1 - h) - L(k * s.r1) * h) + L(s.p) * (v2 - h));
  const L h2 = i * (L(v) * ((v2 - h) - L(k * s.r2) * h) + L(s.p) * (v1 - h));
  const L h11 = i * (L(s.a) * (h1 * h1) - L(2.0 * s.b1) * h1 + L(u));
  const L h12 = i * (L(s.a) * (h1 * h2) - L(s.b1) * h2 - L(s.b2) * h1 + L(s.p));
  const L h22 = i * (L(s.a) * (h2 * h2) - L(2.0 * s.b2) * h2 + L(v));

  // What is 0 together stays 0: the smaller with derivatives 0, the larger as the sum, which is the other one
  // where one is the constant 0.
  const auto nothing = v1 == zero && v2 == zero;
  if (lower) {
    const T blend = chain(x1, x2, lane::min(h, lane::min(v1, v2)), h1, h2, h11, h12, h22);
    return choose<T>(blended, blend, choose<T>(nothing, T(0.0), smaller(x1, x2)));
  }
  const T blend = chain(x1, x2, lane::max(h, lane::max(v1, v2)), h1, h2, h11, h12, h22);
  return choose<T>(blended, blend, choose<T>(nothing, x1 + x2, larger(x1, x2)));
}

KernelSet scale_blend_simd() { return kernel_set<ScaleBlend, Simd>(); }
#if HWY_ONCE
KernelSet scale_blend_scalar() { return kernel_set<ScaleBlend, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(scale_blend_simd);

constexpr double scale_slack = 1e-12;

static double sign(ScaleSide side) { return side == ScaleSide::lower ? 1.0 : -1.0; }

ScaleBlend::ScaleBlend(double r1_, double r2_, double p_, ScaleSide side_)
    : r1(r1_),
      r2(r2_),
      p(p_),
      side(side_),
      k1(1.0 + sign(side) * r1),
      k2(1.0 + sign(side) * r2),
      b1(k1 * r2 * r2 + p),
      b2(k2 * r1 * r1 + p),
      a((1.0 + 2.0 * sign(side) * r2) * r1 * r1 + k1 * k1 * r2 * r2 + 2.0 * p) {}

/// End points; the kernel itself keeps B <= min, or >= max.
static Range scale_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& s = *static_cast<const ScaleBlend*>(body);
  Range r = spread(ends(op_for<ScaleBlend>(), body, args, {true}), scale_slack, 10.0 * negligible);
  if (args[0].lo >= 0.0 && args[1].lo >= 0.0) r.lo = std::max(0.0, r.lo);
  if (s.side == ScaleSide::lower)
    r.hi = std::min({r.hi, args[0].hi, args[1].hi});
  else
    r.lo = std::max({r.lo, args[0].lo, args[1].lo});
  if (std::max(args[0].hi, args[1].hi) > 1e99)  // some of the values are not blended
    r = s.side == ScaleSide::lower ? Range{std::min(0.0, r.lo), r.hi}
                                   : Range{r.lo, std::numeric_limits<double>::infinity()};
  return r;
}

/// Beyond region III on the whole box. r_i >= 1e-9, so K_i x is another number than x.
static Shortcut scale_shortcut(const void* body, const Box&, std::span<const Range> args) {
  const auto& s = *static_cast<const ScaleBlend*>(body);
  const Range x1 = args[0], x2 = args[1];
  if (s.side == ScaleSide::lower) {
    if ((is(x1, 0.0) && x2.lo >= 0.0) || (is(x2, 0.0) && x1.lo >= 0.0)) return Shortcut::to_constant(0.0);
    if (x2.lo > 0.0 && x1.lo >= s.k1 * x2.hi) return Shortcut::to_argument(1);
    if (x1.lo > 0.0 && x2.lo >= s.k2 * x1.hi) return Shortcut::to_argument(0);
    return {};
  }
  if (is(x1, 0.0) && x2.lo >= 0.0) return Shortcut::to_argument(1);
  if (is(x2, 0.0) && x1.lo >= 0.0) return Shortcut::to_argument(0);
  if (x2.lo > 0.0 && x1.hi <= s.k1 * x2.lo) return Shortcut::to_argument(1);
  if (x1.lo > 0.0 && x2.hi <= s.k2 * x1.lo) return Shortcut::to_argument(0);
  return {};
}

}  // namespace detail

template <>
const Op& op_for<detail::ScaleBlend>() {
  using namespace detail;
  static const Op op{"scale_blend", HWY_DYNAMIC_DISPATCH(scale_blend_simd)(),
                     HWY_STATIC_DISPATCH(scale_blend_scalar)(), scale_range, scale_shortcut};
  return op;
}

}  // namespace blendwright
#endif
