#include "implicit/operators/function_rockwood.hpp"

#include "implicit/number/targets.hpp"
#include "implicit/operators/function_bounds.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/function_rockwood.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"
#include "implicit/operators/function_saturate-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

template <class T>
HWY_INLINE T evaluate(const RockwoodRaw& b, const Inputs<T>& in) {
  T sum = T(-1.0);
  for (std::size_t i = 0; i < in.args(); ++i) {
    const T x = saturated(positive_part(saturated(in.arg(i)) * b.shape.inverse_r[i] + 1.0));
    sum = sum + saturated(power(x, b.shape.w));
  }
  return saturated(sum);
}

template <class T>
HWY_INLINE T evaluate(const Cutoff& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T g = in.arg(0);
  const double inverse = 1.0 / b.fade;
  const L given = value_of(g) * L(inverse), t = lane::min(lane::max(given, L(0.0)), L(1.0));
  const L value = t * t * t * multiply_add(t, multiply_add(t, L(6.0), L(-15.0)), L(10.0)), less = L(1.0) - t;
  return choose<T>(given > L(0.0) && given < L(1.0),
                   chain(g, lane::min(value, L(1.0)), L(30.0 * inverse) * (t * t) * (less * less),
                         L(60.0 * inverse * inverse) * t * less * (less - t)),
                   constant<T>(t));
}

KernelSet rockwood_raw_simd() { return kernel_set<RockwoodRaw, Simd>(); }
KernelSet cutoff_simd() { return kernel_set<Cutoff, Simd>(); }
#if HWY_ONCE
KernelSet rockwood_raw_scalar() { return kernel_set<RockwoodRaw, double>(); }
KernelSet cutoff_scalar() { return kernel_set<Cutoff, double>(); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(rockwood_raw_simd);
HWY_EXPORT(cutoff_simd);

SuperEllipse::SuperEllipse(std::vector<double> reaches, double weight)
    : r(std::move(reaches)), w(weight), inverse_w(1.0 / weight) {
  for (const double x : r) inverse_r.push_back(1.0 / x);
}

/// 1 + f/r loses what f/r rounds by, and the power w times that.
static double rounding(const SuperEllipse& b, double value) {
  return range_slack * b.w.exponent * (2.0 + std::abs(value));
}

static Range rockwood_raw_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const RockwoodRaw*>(body);
  const Range r = ends(op_for<RockwoodRaw>(), body, args, {true});
  return saturated(Range{r.lo - rounding(b.shape, r.lo), r.hi + rounding(b.shape, r.hi)});
}

/// The sum of convex functions of one argument each.
static LinearBound rockwood_raw_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const RockwoodRaw*>(body);
  const double w = b.shape.w.exponent;
  LinearBound sum = constant_bound({-1.0, -1.0});
  for (std::size_t i = 0; i < in.args.size(); ++i) {
    const Range f = in.ranges[i];
    const double inverse = b.shape.inverse_r[i];
    const auto x = [&](double value) { return std::max(0.0, 1.0 + value * inverse); };
    const double most = std::pow(x(f.hi), w), size = std::max(std::abs(f.lo), std::abs(f.hi));
    if (!(most <= 1e90 && size <= 1e90)) return constant_bound(Range::everything());
    const double at = std::clamp(in.args[i].value, f.lo, f.hi),
                 slope = w * inverse * std::pow(x(at), w - 1.0);
    const AtThree values{std::pow(x(at), w), x(at) > 0.0 ? slope : 0.0, std::pow(x(f.lo), w), most};
    LinearBound u = in.args[i];
    u.value = at;
    u.rest = u.rest + Range{in.args[i].value - at, in.args[i].value - at};
    sum = sum + of_convex(u, f, values, 4.0 * rounding(b.shape, most));
  }
  return sum;
}

static Range cutoff_range(const void* body, const Box&, std::span<const Range> args) {
  const Range r = spread(ends(op_for<Cutoff>(), body, args, {true}), range_slack);
  return {std::max(r.lo, 0.0), std::min(r.hi, 1.0)};
}
static Shortcut cutoff_shortcut(const void* body, const Box&, std::span<const Range> args) {
  const double inverse = 1.0 / static_cast<const Cutoff*>(body)->fade;
  if (args[0].hi <= 0.0) return Shortcut::to_constant(0.0);
  return args[0].lo * inverse >= 1.0 ? Shortcut::to_constant(1.0) : Shortcut{};
}
/// The slope 30 t^2 (1 - t)^2/fade rises up to t = 1/2 and falls.
static LinearBound cutoff_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const Cutoff*>(body);
  const Middle middle(in);
  if (!middle.usable) return constant_bound(Range::everything());
  const auto t = [&](double g) { return std::clamp(g / b.fade, 0.0, 1.0); };
  const auto slope = [&](double s) { return 30.0 * s * s * (1.0 - s) * (1.0 - s) / b.fade; };
  const double lo = t(in.ranges[0].lo), hi = t(in.ranges[0].hi);
  Range steep{std::min(slope(lo), slope(hi)), std::max(slope(lo), slope(hi))};
  if (lo < 0.5 && hi > 0.5) steep.hi = slope(0.5);
  const double value = scalar_value(op_for<Cutoff>(), body, Vec3::Zero(), {middle.at, 1});
  const Range partials[] = {spread(steep, range_slack)};
  return mean_value_bound(in, middle, value, partials, range_slack);
}

}  // namespace detail

template <>
const Op& op_for<detail::RockwoodRaw>() {
  using namespace detail;
  static const Op op{"rockwood_raw",
                     HWY_DYNAMIC_DISPATCH(rockwood_raw_simd)(),
                     HWY_STATIC_DISPATCH(rockwood_raw_scalar)(),
                     rockwood_raw_range,
                     nullptr,
                     rockwood_raw_linear};
  return op;
}
template <>
const Op& op_for<detail::Cutoff>() {
  using namespace detail;
  static const Op op{"cutoff",
                     HWY_DYNAMIC_DISPATCH(cutoff_simd)(),
                     HWY_STATIC_DISPATCH(cutoff_scalar)(),
                     cutoff_range,
                     cutoff_shortcut,
                     cutoff_linear};
  return op;
}

}  // namespace blendwright
#endif
