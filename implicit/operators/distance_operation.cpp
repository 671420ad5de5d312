#include "implicit/operators/distance_operation.hpp"

#include <algorithm>

#include "implicit/eval/linear_shapes.hpp"
#include "implicit/number/targets.hpp"
#include "implicit/operators/function_bounds.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/distance_operation.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/number/p_norm-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

inline constexpr double infinite = std::numeric_limits<double>::infinity();
inline constexpr double most = std::numeric_limits<double>::max();

// With m <= M, q = m/M and S = 1 + q^n: D = m S^(-1/n), D_m = (D/m)/S, D_M = D_m q^n q. D is homogeneous of
// degree 1 and D_mM = (n + 1) D_m D_M/D.
template <class T>
HWY_INLINE T evaluate(const Dilation& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T x = in.arg(0), y = in.arg(1);
  const auto ordered = value_of(x) <= value_of(y);
  const T least = choose<T>(ordered, x, y), other = choose<T>(ordered, y, x);
  const L lo = value_of(least), hi = value_of(other), nothing = negligible;
  const auto plain = lo > nothing && hi <= L(most);
  const L m = select(plain, lo, L(1.0)), q = m / select(plain, hi, L(1.0));
  const L power_n = lane_power(q, b.n), is = L(1.0) / (L(1.0) + power_n);
  const L ratio = L(1.0) / lane_power(L(1.0) + power_n, b.inverse_n), f = m * ratio;
  const L fm = ratio * is, fo = fm * power_n * q;
  const L bend = L(b.n.exponent + 1.0) * (fm * fm) * power_n / f;
  const T blend = chain(least, other, f, fm, fo, -bend, bend * q, -(bend * (q * q)));
  return choose<T>(plain, blend, choose<T>(hi <= nothing, T(0.0), least));
}

// E = d g, g = (1 - q^n)^(-1/n), q = d/T; 1 - q^n = -expm1(-n log1p((T - d)/d)), which keeps its digits for T
// next to d. E_d = g/(1 - q^n), E_T = -E_d q^n q, E_dT = (n + 1) E_d E_T/E; E is homogeneous of degree 1.
template <class T>
HWY_INLINE T evaluate(const Erosion& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T x = in.arg(0), y = in.arg(1);
  const L nothing = negligible, d = lane::max(value_of(x), nothing), n = b.n;
  const auto plain = value_of(x) > nothing && value_of(y) <= L(most) && value_of(y) > d;
  const L t = select(plain, value_of(y), d + d), q = d / t;
  L rest = (t - d) / t, g = t / (t - d);
  if (b.n != 1.0) {
    const L excess = lane::min((t - d) / d, L(1e300));
    rest = -lane::expm1(-(n * lane::log1p(excess)));
    g = lane::exp(-(lane::log(rest) / n));
  }
  const L power_n = L(1.0) - rest, fd = g / rest, ft = fd * power_n * q, f = d * g;
  const L bend = (n + L(1.0)) * (fd * fd) * power_n / f;
  const T eroded =
      choose<T>(g < L(1e60), chain(x, y, f, fd, -ft, bend, -(bend * q), bend * (q * q)), T(infinite));
  const auto through = value_of(x) > nothing && value_of(y) <= d;
  return choose<T>(plain, eroded, choose<T>(through, T(infinite), x));
}

template <class T>
HWY_INLINE T evaluate(const RayScaling& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const Point<T> p = in.local();
  const T coordinates[3] = {p.x, p.y, p.z}, r = length(coordinates), d = in.arg(0), t = in.arg(1);
  const auto plain = value_of(r) > L(negligible) && value_of(t) > L(negligible) && value_of(t) <= L(most) &&
                     value_of(d) <= L(most);
  const T radius = choose<T>(plain, r, T(1.0)), gauge = choose<T>(plain, t, T(1.0));
  const T factor = power(b.inverted ? gauge / radius : radius / gauge, b.n);
  const auto bounded = value_of(factor) <= L(1e150);
  const T scaled_distance = choose<T>(plain, d, T(0.0)) * choose<T>(bounded, factor, T(1.0));
  // T = 0 or infinite is no direction of a bounded T; the limits are (r/T)^n = 0 or infinite
  const auto large = b.inverted ? value_of(t) > L(most) : value_of(t) <= L(negligible);
  const T limit = choose<T>(value_of(r) <= L(negligible), T(0.0),
                            choose<T>(large || value_of(d) > L(most), T(infinite), T(0.0)));
  return choose<T>(plain, choose<T>(bounded, scaled_distance, T(infinite)), limit);
}

KernelSet dilation_simd() { return kernel_set<Dilation, Simd>(); }
KernelSet erosion_simd() { return kernel_set<Erosion, Simd>(); }
KernelSet ray_scaling_simd() { return kernel_set<RayScaling, Simd>(); }
#if HWY_ONCE
KernelSet dilation_scalar() { return kernel_set<Dilation, double>(); }
KernelSet erosion_scalar() { return kernel_set<Erosion, double>(); }
KernelSet ray_scaling_scalar() { return kernel_set<RayScaling, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(dilation_simd);
HWY_EXPORT(erosion_simd);
HWY_EXPORT(ray_scaling_simd);

constexpr double infinity = std::numeric_limits<double>::infinity();

static Range dilation_range(const void* body, const Box&, std::span<const Range> args) {
  const double n = static_cast<const Dilation*>(body)->n.exponent;
  return spread_positive(ends(op_for<Dilation>(), body, args, {true}), range_slack * (1.0 + 1.0 / n));
}
/// Concave where no argument is negative.
static LinearBound dilation_linear(const void* body, const LinearInput& in) {
  const double n = static_cast<const Dilation*>(body)->n.exponent;
  const LinearBound inner[] = {recentred(in.args[0], in.ranges[0]), recentred(in.args[1], in.ranges[1])};
  LinearInput part = in;
  part.args = inner;
  const Middle middle(part);
  for (std::size_t i = 0; i < 2; ++i)
    if (!middle.usable || in.ranges[i].lo < 0.0 || middle.at[i] <= 2.0 * negligible)
      return constant_bound(Range::everything());
  return tangent_bound(op_for<Dilation>(), body, part, Bend::concave,
                       range_slack * (1.0 + 1.0 / n) * size_of(in.ranges) + 10.0 * negligible);
}
static Shortcut dilation_shortcut(const void*, const Box&, std::span<const Range> args) {
  if (is(args[0], 0.0) || is(args[1], 0.0)) return Shortcut::to_constant(0.0);
  if (is(args[0], infinity)) return Shortcut::to_argument(1);
  return is(args[1], infinity) ? Shortcut::to_argument(0) : Shortcut{};
}

/// The root (1 - q^n)^(-1/n) has the relative error of ln(1 - q^n)/n >= -37/n, 37 = -ln(eps).
static Range erosion_range(const void* body, const Box&, std::span<const Range> args) {
  const double n = static_cast<const Erosion*>(body)->n;
  return spread_positive(ends(op_for<Erosion>(), body, args, {true, false}), range_slack * (1.0 + 1.0 / n));
}
/// Convex for 0 < d < T: its second derivatives are a positive multiple of (1, -q)(1, -q)^T.
static LinearBound erosion_linear(const void* body, const LinearInput& in) {
  const double n = static_cast<const Erosion*>(body)->n;
  const Range d = in.ranges[0], t = in.ranges[1];
  const Range range = erosion_range(body, in.local, in.ranges);
  if (!(d.lo > 2.0 * negligible) || !(t.lo > d.hi) || !std::isfinite(range.hi))
    return constant_bound(Range::everything());
  return tangent_bound(op_for<Erosion>(), body, in, Bend::convex, range_slack * (1.0 + 1.0 / n) * range.hi);
}
static Shortcut erosion_shortcut(const void*, const Box&, std::span<const Range> args) {
  if (args[0].lo > negligible && args[1].hi <= args[0].lo) return Shortcut::to_constant(infinity);
  return is(args[1], infinity) && args[0].hi < infinity ? Shortcut::to_argument(0) : Shortcut{};
}

static Range ray_scaling_range(const void* body, const Box& local, std::span<const Range> args) {
  const auto& b = *static_cast<const RayScaling*>(body);
  const Range d = args[0], t = args[1];
  Vec3 nearest, farthest;
  for (int i = 0; i < 3; ++i) {
    const Range m = magnitude(local.axis(i));
    nearest[i] = m.lo;
    farthest[i] = m.hi;
  }
  const Range r{nearest.stableNorm(), farthest.stableNorm()};
  const Range above = b.inverted ? t : r, below = b.inverted ? r : t;
  const auto power_of = [&](double ratio) { return std::pow(ratio, b.n.exponent); };
  // Sharper than the bounds over all directions where the box is small and away from the origin.
  const double lo = std::max(b.factor.lo, below.hi > 0.0 ? power_of(above.lo / below.hi) : 0.0);
  const double hi = std::min(b.factor.hi, below.lo > 0.0 ? power_of(above.hi / below.lo) : infinity);
  const bool at_origin = r.lo <= 2.0 * negligible || d.lo <= 0.0 || std::isnan(lo);
  const Range value{at_origin ? 0.0 : d.lo * lo, d.hi == 0.0 ? 0.0 : d.hi * (std::isnan(hi) ? infinity : hi)};
  return spread_positive(value, range_slack * (2.0 + b.n.exponent));
}

/// ln f = ln d + n ln r - n ln T.
static LinearBound ray_scaling_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const RayScaling*>(body);
  const double n = b.inverted ? -b.n.exponent : b.n.exponent;
  const Range d = in.ranges[0], t = in.ranges[1];
  Range r;
  {
    Vec3 nearest, farthest;
    for (int i = 0; i < 3; ++i) {
      const Range m = magnitude(in.local.axis(i));
      nearest[i] = m.lo;
      farthest[i] = m.hi;
    }
    r = Range{nearest.stableNorm(), farthest.stableNorm()}.widened(range_slack);
  }
  const auto usable = [](Range x) { return x.lo > 1e3 * negligible && x.hi < 1e60; };
  const Range f = ray_scaling_range(body, in.local, in.ranges);
  if (!usable(d) || !usable(t) || !usable(r) || !(f.lo > 0.0) || !(f.hi < 1e150))
    return constant_bound(Range::everything());
  const LinearBound sum = logarithm_bound(in.args[0], d) +
                          (n * logarithm_bound(length_bound(in), r) + -n * logarithm_bound(in.args[1], t));
  const double size = std::abs(std::log(d.lo)) + std::abs(std::log(d.hi)) +
                      b.n.exponent * (std::abs(std::log(r.lo)) + std::abs(std::log(r.hi)) +
                                      std::abs(std::log(t.lo)) + std::abs(std::log(t.hi)));
  const double slack = range_slack * (1.0 + size);
  const Range over{std::log(f.lo) - slack, std::log(f.hi) + slack};
  return exponential_bound(sum, over).widened(range_slack * (2.0 + b.n.exponent) * f.hi);
}

}  // namespace detail

template <>
const Op& op_for<detail::Dilation>() {
  using namespace detail;
  static const Op op{"dilation",
                     HWY_DYNAMIC_DISPATCH(dilation_simd)(),
                     HWY_STATIC_DISPATCH(dilation_scalar)(),
                     dilation_range,
                     dilation_shortcut,
                     dilation_linear};
  return op;
}
template <>
const Op& op_for<detail::Erosion>() {
  using namespace detail;
  static const Op op{"erosion",
                     HWY_DYNAMIC_DISPATCH(erosion_simd)(),
                     HWY_STATIC_DISPATCH(erosion_scalar)(),
                     erosion_range,
                     erosion_shortcut,
                     erosion_linear};
  return op;
}
template <>
const Op& op_for<detail::RayScaling>() {
  using namespace detail;
  static const Op op{"ray_scaling",
                     HWY_DYNAMIC_DISPATCH(ray_scaling_simd)(),
                     HWY_STATIC_DISPATCH(ray_scaling_scalar)(),
                     ray_scaling_range,
                     nullptr,
                     ray_scaling_linear};
  return op;
}

}  // namespace blendwright
#endif
