#include "implicit/operators/scale_blend.hpp"

#include <algorithm>

#include "implicit/number/targets.hpp"
#include "implicit/operators/function_bounds.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/scale_blend.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/operators/arc-inl.hpp"

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
  const L line1 = L(s.k1) * v2, line2 = L(s.k2) * v1, least = lane::min(v1, v2), most = lane::max(v1, v2);
  const auto between = lower ? (v1 < line1 && v2 < line2) : (v1 > line1 && v2 > line2);
  const auto blended = between && least > zero && most > L(negligible) && most < L(largest_blended);

  const L m = lower ? least : most, d = most - least;
  const auto first = v1 == m;  // else the second is the nearer one
  const L r_near = select(first, L(s.r1), L(s.r2)), r_far = select(first, L(s.r2), L(s.r1));
  const Arc<L> at = arc(s.sum, s.w, d, r_near * lane::max(r_far * m - d, zero));
  const L h = lower ? m - at.t : m + at.t;
  const L far = d + at.t, y1 = select(first, at.t, far), y2 = select(first, far, at.t);
  const ArcGradient<L> g = arc_gradient(s, y1, y2, at.q);
  // In this order nothing leaves the range of numbers.
  const L i = L(1.0) / (g.g1 * v1 + g.g2 * v2), hi = h * i, n1 = v1 * i, n2 = v2 * i;
  const L bend = lower ? (g.k * i) * h : -((g.k * i) * h);
  const L h11 = -((bend * v2) * i) * n2, h12 = ((bend * v1) * i) * n2, h22 = -((bend * v1) * i) * n1;
  const T blend = chain(x1, x2, h, hi * g.g1, hi * g.g2, h11, h12, h22);

  // What is 0 together stays 0: the smaller with derivatives 0, the larger as the sum, which is the other one
  // where one is the constant 0.
  const auto nothing = v1 == zero && v2 == zero;
  if (lower) return choose<T>(blended, blend, choose<T>(nothing, T(0.0), smaller(x1, x2)));
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

static double sign(ScaleSide side) { return side == ScaleSide::lower ? 1.0 : -1.0; }

ScaleBlend::ScaleBlend(double r1_, double r2_, double p, ScaleSide side_)
    : r1(r1_),
      r2(r2_),
      side(side_),
      k1(1.0 + sign(side) * r1),
      k2(1.0 + sign(side) * r2),
      sum(r1 + r2 + sign(side) * (r1 * r2)),
      w(std::fma(r1, r2, -p)) {}

/// End points; B <= min, or >= max, also as it is rounded.
static Range scale_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& s = *static_cast<const ScaleBlend*>(body);
  Range r = spread(ends(op_for<ScaleBlend>(), body, args, {true}), range_slack, 10.0 * negligible);
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

/// Lower is concave, upper convex, where both are blended as they should be: not next to (0, 0), where a
/// slope is given that no plane above lower has, and not far out.
static LinearBound scale_linear(const void* body, const LinearInput& in) {
  const auto& s = *static_cast<const ScaleBlend*>(body);
  const Middle middle(in);
  const double size = size_of(in.ranges);
  if (!middle.usable || size > 1e99 ||
      std::max(std::abs(middle.at[0]), std::abs(middle.at[1])) <= 1e3 * negligible)
    return constant_bound(Range::everything());
  const Bend bend = s.side == ScaleSide::lower ? Bend::concave : Bend::convex;
  return tangent_bound(op_for<ScaleBlend>(), body, in, bend, 4.0 * range_slack * size + 10.0 * negligible);
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
  static const Op op{"scale_blend",
                     HWY_DYNAMIC_DISPATCH(scale_blend_simd)(),
                     HWY_STATIC_DISPATCH(scale_blend_scalar)(),
                     scale_range,
                     scale_shortcut,
                     scale_linear};
  return op;
}

}  // namespace blendwright
#endif
