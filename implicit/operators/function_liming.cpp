#include "implicit/operators/function_liming.hpp"

#include "implicit/number/targets.hpp"
#include "implicit/operators/function_bounds.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/function_liming.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/operators/function_saturate-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

/// P^k, k >= 2; values beyond what saturates are infinite or not, alike.
template <class T>
HWY_INLINE T whole_power(const T& P, int k) {
  using L = LaneOf<T>;
  const L v = value_of(P), low = k == 2 ? L(1.0) : integer_power(v, k - 2);
  return chain(P, low * v * v, L(k) * (low * v), L(k * (k - 1.0)) * low);
}

template <class T>
HWY_INLINE T evaluate(const Liming& b, const Inputs<T>& in) {
  const T A = saturated(in.arg(0)), B = saturated(in.arg(1)), P = saturated(in.arg(2));
  return saturated((A * B) * (1.0 - b.u) - whole_power(P, b.n + 1) * b.u);
}

template <class T>
HWY_INLINE T evaluate(const LimingClipped& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  // The union is written with a = -f; the sign of its result is the opposite of the intersection's.
  const T x = saturated(in.arg(0)) * (-b.c_a * outer_sign(b.join, 0));
  const T y = saturated(in.arg(1)) * (-b.c_b * outer_sign(b.join, 1));
  const T P = positive_part(b.r - (x + y)), product = x * y;
  const L zero = 0.0;
  const T off = choose<T>(value_of(x) > zero || value_of(y) > zero, product, T(0.0));
  return saturated(square(P) * b.u - off * (1.0 - b.u)) * -result_sign(b.join);
}

KernelSet liming_simd() { return kernel_set<Liming, Simd>(); }
KernelSet liming_clipped_simd() { return kernel_set<LimingClipped, Simd>(); }
#if HWY_ONCE
KernelSet liming_scalar() { return kernel_set<Liming, double>(); }
KernelSet liming_clipped_scalar() { return kernel_set<LimingClipped, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(liming_simd);
HWY_EXPORT(liming_clipped_simd);

/// x^k over a range, k >= 0 an integer.
static Range power_range(Range x, int k) {
  if (k == 0) return {1.0, 1.0};
  if (k % 2 != 0) return {std::pow(x.lo, k), std::pow(x.hi, k)};
  const Range m = magnitude(x);
  return {std::pow(m.lo, k), std::pow(m.hi, k)};
}
/// Rounding of a sum of terms of these sizes.
static double rounding(std::initializer_list<Range> terms) {
  double size = 0.0;
  for (const Range& t : terms) size += std::max(std::abs(t.lo), std::abs(t.hi));
  return range_slack * size + 1e-300;
}
static Range widened(Range r, double slack) { return saturated(Range{r.lo - slack, r.hi + slack}); }

static Range liming_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const Liming*>(body);
  const Range product = (1.0 - b.u) * (saturated(args[0]) * saturated(args[1]));
  Range power = -b.u * power_range(saturated(args[2]), b.n + 1);
  // Infinite terms saturate whatever is added to them.
  power = {std::max(power.lo, -1e300), std::min(power.hi, 1e300)};
  const double slack = rounding({product, (1.0 + b.n) * power});
  return widened(product + power, std::isfinite(slack) ? slack : 0.0);
}

/// Exact but for the second-order terms: dA dB and the rest of the power, whose second derivative is bounded.
static LinearBound liming_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const Liming*>(body);
  const Middle middle(in);
  const double size = size_of(in.ranges);
  if (!middle.usable || !(size <= 1e15) || b.n > 4) return constant_bound(Range::everything());
  const ArgumentGradient g = argument_gradient(op_for<Liming>(), body, {middle.at, 3});
  const Range dP = middle.offset(2);
  Range bend = (0.5 * b.n * (b.n + 1)) * power_range(in.ranges[2], b.n - 1);
  bend = {std::min(bend.lo, 0.0), std::max(bend.hi, 0.0)};
  const Range rest = (1.0 - b.u) * (middle.offset(0) * middle.offset(1)) + -b.u * (bend * squared(dP));
  const Range product = in.ranges[0] * in.ranges[1], power = power_range(in.ranges[2], b.n + 1);
  return expansion_bound(in, middle, g, rest, rounding({product, (1.0 + b.n) * power}));
}

/// x = c_a a and y = c_b b.
struct OuterRanges {
  Range x, y;
  OuterRanges(const LimingClipped& b, std::span<const Range> args)
      : x((-b.c_a * outer_sign(b.join, 0)) * saturated(args[0])),
        y((-b.c_b * outer_sign(b.join, 1)) * saturated(args[1])) {}
  /// r - x - y.
  [[nodiscard]] Range chord(double r) const { return {r - x.hi - y.hi, r - x.lo - y.lo}; }
  /// x y, but 0 where both are negative: its extremes are in corners of the pieces that zero cuts.
  [[nodiscard]] Range product() const {
    const auto at = [](double a, double b) { return a < 0.0 && b < 0.0 ? 0.0 : a * b; };
    const double p[] = {at(x.lo, y.lo), at(x.lo, y.hi), at(x.hi, y.lo), at(x.hi, y.hi)};
    Range r{*std::min_element(p, p + 4), *std::max_element(p, p + 4)};
    if (x.contains(0.0) || y.contains(0.0)) r = {std::min(r.lo, 0.0), std::max(r.hi, 0.0)};
    return r;
  }
  /// Its partial by x: y, or 0 where both are negative.
  [[nodiscard]] static Range slope(Range x, Range y) {
    if (x.lo >= 0.0 || y.lo >= 0.0) return y;
    return {x.hi > 0.0 ? y.lo : 0.0, std::max(y.hi, 0.0)};
  }
};

static double clipped_rounding(const LimingClipped& b, const OuterRanges& at) {
  const double size =
      b.r + std::max(std::abs(at.x.lo), std::abs(at.x.hi)) + std::max(std::abs(at.y.lo), std::abs(at.y.hi));
  return 8.0 * range_slack * size * size;
}

static Range liming_clipped_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const LimingClipped*>(body);
  const OuterRanges at(b, args);
  const Range P = at.chord(b.r);
  const double lo = std::max(P.lo, 0.0), hi = std::max(P.hi, 0.0);
  const Range phi = b.u * Range{lo * lo, hi * hi} + -(1.0 - b.u) * at.product();
  return widened(-result_sign(b.join) * phi, clipped_rounding(b, at));
}

/// The partials by x are -2 u P+ - (1 - u) y, the product's share being 0 where x and y are negative.
static LinearBound liming_clipped_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const LimingClipped*>(body);
  const Middle middle(in);
  const OuterRanges at(b, in.ranges);
  const double slack = clipped_rounding(b, at);
  if (!middle.usable || !(slack <= 1e80)) return constant_bound(Range::everything());
  const Range P = at.chord(b.r), chord = -2.0 * b.u * Range{std::max(P.lo, 0.0), std::max(P.hi, 0.0)};
  const Range by_x = chord + -(1.0 - b.u) * OuterRanges::slope(at.x, at.y);
  const Range by_y = chord + -(1.0 - b.u) * OuterRanges::slope(at.y, at.x);
  const double sign = -result_sign(b.join);
  const Range partials[] = {spread((sign * -b.c_a * outer_sign(b.join, 0)) * by_x, range_slack),
                            spread((sign * -b.c_b * outer_sign(b.join, 1)) * by_y, range_slack)};
  const double value = scalar_value(op_for<LimingClipped>(), body, Vec3::Zero(), {middle.at, 2});
  return mean_value_bound(in, middle, value, partials, slack);
}

}  // namespace detail

template <>
const Op& op_for<detail::Liming>() {
  using namespace detail;
  static const Op op{"liming",
                     HWY_DYNAMIC_DISPATCH(liming_simd)(),
                     HWY_STATIC_DISPATCH(liming_scalar)(),
                     liming_range,
                     nullptr,
                     liming_linear};
  return op;
}
template <>
const Op& op_for<detail::LimingClipped>() {
  using namespace detail;
  static const Op op{"liming_clipped",
                     HWY_DYNAMIC_DISPATCH(liming_clipped_simd)(),
                     HWY_STATIC_DISPATCH(liming_clipped_scalar)(),
                     liming_clipped_range,
                     nullptr,
                     liming_clipped_linear};
  return op;
}

}  // namespace blendwright
#endif
