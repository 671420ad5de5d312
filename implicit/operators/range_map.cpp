#include "implicit/operators/range_map.hpp"

#include <algorithm>

#include "implicit/eval/linear_shapes.hpp"
#include "implicit/number/targets.hpp"
#include "implicit/operators/function_bounds.hpp"
#include "implicit/operators/range_rules.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "implicit/operators/range_map.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once per instruction set

#include "implicit/eval/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace blendwright::detail::HWY_NAMESPACE {

// The inner quadratic has its root at the lower end, q = d - (1 - w2)/2 = 0:
//   1/2 + t/w1 + A t^2 = q (A q + g),  g = 2/w2 - 1/w1 = T' there, >= 0 when T is monotone.
// In this form nothing cancels.
template <class T>
HWY_INLINE T evaluate(const RangeMap& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T x = in.arg(0);
  const double lower = 0.5 * (1.0 - b.w2), upper = 0.5 * (1.0 + b.w1);
  const L d = lane::min(lane::max(value_of(x), L(lower)), L(upper));
  const L slope = 1.0 / b.w1, bend = 2.0 * (1.0 / b.w1 - 1.0 / b.w2) / b.w2;
  const L start = std::max(0.0, 2.0 / b.w2 - 1.0 / b.w1), q = d - L(lower);
  const auto inner = d < L(0.5);
  const L f = select(inner, q * (q * bend + start), lane::min(L(0.5) + (d - L(0.5)) * slope, L(1.0)));
  const T t = chain(x, f, select(inner, (q + q) * bend + start, slope), select(inner, bend + bend, L(0.0)));
  return choose<T>(value_of(x) <= L(lower), T(0.0), choose<T>(value_of(x) >= L(upper), T(1.0), t));
}

/// 1/w of d and f_c: f_c/e, e = 2 d - f_c, where a = e/f_c >= 2 w0; 4 w0 f_c^2/(4 w0^2 f_c^2 + e^2) where
/// 0 < a < 2 w0; 1/w0 else.
template <class T>
HWY_INLINE T inverse_width(double floor, const T& d, const T& contour) {
  using L = LaneOf<T>;
  const T e = d + d - contour, c2 = square(contour);
  const auto exact = value_of(e) >= L(2.0 * floor) * value_of(contour), least = value_of(e) <= L(0.0);
  const T above = choose<T>(exact, contour, choose<T>(least, T(1.0 / floor), c2 * (4.0 * floor)));
  const T below = choose<T>(exact, e, choose<T>(least, T(1.0), c2 * (4.0 * floor * floor) + square(e)));
  return above / below;
}
/// T of d >= 1/2, not yet limited to 1.
template <class T>
HWY_INLINE T outside(const VirMap& b, const T& d, const T& contour) {
  return (d - 0.5) * inverse_width(b.w_floor, d, contour) + 0.5;
}
/// T of d < 1/2, not yet limited to 0; q (A q + g) as above.
template <class T>
HWY_INLINE T inside(const VirMap& b, const T& d, const T& contour) {
  const T q = d - 0.5 * (1.0 - b.w2);
  if (!b.coupled) return q * (1.0 / b.w2);
  const T steepness = inverse_width(b.w_floor, d, contour);
  return q * (q * ((steepness - 1.0 / b.w2) * (2.0 / b.w2)) + (2.0 / b.w2 - steepness));
}
HWY_INLINE double lower_end(const VirMap& b) { return std::max(0.5 * (1.0 - b.w2), negligible); }

template <class T>
HWY_INLINE T evaluate(const VirMap& b, const Inputs<T>& in) {
  using L = LaneOf<T>;
  const T d = in.arg(0), contour = in.arg(1), out = outside(b, d, contour), core = inside(b, d, contour);
  // also where an infinite argument makes it NaN
  const T outer = choose<T>(!(value_of(out) < L(1.0)), T(1.0), out);
  const T inner = choose<T>(value_of(d) <= L(lower_end(b)) || value_of(core) <= L(0.0), T(0.0), core);
  return choose<T>(value_of(d) < L(0.5), inner, outer);
}

KernelSet range_map_simd() { return kernel_set<RangeMap, Simd>(); }
KernelSet vir_map_simd() { return kernel_set<VirMap, Simd>(); }
#if HWY_ONCE
KernelSet range_map_scalar() { return kernel_set<RangeMap, double>(); }
KernelSet vir_map_scalar() { return kernel_set<VirMap, double>(); }
double vir_outside(const VirMap& b, double d, double contour) { return outside<double>(b, d, contour); }
double vir_steepness(const VirMap& b, double d, double contour) {
  return inverse_width<double>(b.w_floor, d, contour);
}
double vir_lower_end(const VirMap& b) { return lower_end(b); }
#endif

}  // namespace blendwright::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace blendwright {
namespace detail {
HWY_EXPORT(range_map_simd);
HWY_EXPORT(vir_map_simd);

static Range range_map_range(const void* body, const Box&, std::span<const Range> args) {
  const Range r = ends(op_for<RangeMap>(), body, args, {true});
  return {r.lo, std::min(1.0, r.hi)};
}
static Shortcut range_map_shortcut(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const RangeMap*>(body);
  if (args[0].lo >= 0.5 * (1.0 + b.w1)) return Shortcut::to_constant(1.0);
  return args[0].hi <= 0.5 * (1.0 - b.w2) ? Shortcut::to_constant(0.0) : Shortcut{};
}

/// T at d, and its slopes; they jump at the outer corners.
static Knot range_map_knot(const RangeMap& b, double d) {
  const double lower = 0.5 * (1.0 - b.w2), upper = 0.5 * (1.0 + b.w1), slope = 1.0 / b.w1;
  if (d < lower) return {d, 0.0, 0.0, 0.0};
  if (d > upper) return {d, 1.0, 0.0, 0.0};
  if (d == upper) return {d, 1.0, slope, 0.0};
  if (d >= 0.5) return {d, std::min(0.5 + (d - 0.5) * slope, 1.0), slope, slope};
  const double bend = 2.0 * (1.0 / b.w1 - 1.0 / b.w2) / b.w2, start = std::max(0.0, 2.0 / b.w2 - 1.0 / b.w1);
  const double q = d - lower, right = 2.0 * q * bend + start;
  return {d, q * (q * bend + start), d == lower ? 0.0 : right, right};
}
static LinearBound range_map_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const RangeMap*>(body);
  const double joints[] = {0.5 * (1.0 - b.w2), 0.5, 0.5 * (1.0 + b.w1)};
  const Curve curves[] = {Curve::convex, b.w1 < b.w2 ? Curve::convex : Curve::concave, Curve::convex,
                          Curve::convex};
  const auto at = [](const void* of, double d) {
    return range_map_knot(*static_cast<const RangeMap*>(of), d);
  };
  return of_curves(in.args[0], in.ranges[0], joints, curves, at, body, 4.0 * range_slack);
}

/// What rounding can change T by. Outside, T <= 1: e = 2 d - f_c has the error eps (2 d + f_c) <= eps e (1 +
/// 1/w0) where it is at least 2 w0 f_c, and below that 1/w is within 1/(2 w0) of its value at e = 0 in the
/// same way; the rest is a few eps. Inside the terms are at most 1/w0, as 1/w is.
static double vir_slack(const VirMap& b) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  return 8.0 * eps * (2.0 + 1.0 / b.w_floor);
}

/// Coupled, d in [lo, hi] below 1/2. T rises with w at every d, so it is bounded by T with the least and the
/// greatest w; for one w it is a parabola through (lower end, 0) and (1/2, 1/2), rising when w2 <= 2 w. If
/// not, it dips below 0 after the lower end, and T = 0 is the bound there.
static Range coupled_range(const VirMap& b, const Range& d, const Range& contour) {
  const double lower = 0.5 * (1.0 - b.w2), slack = vir_slack(b);
  const auto at = [&](double x, double steepness) {
    const double q = x - lower;
    return q * (q * (steepness - 1.0 / b.w2) * (2.0 / b.w2) + (2.0 / b.w2 - steepness));
  };
  const double least_d = std::max(d.lo, negligible), most_d = std::max(d.hi, negligible);
  const double steepest = HWY_STATIC_DISPATCH(vir_steepness)(b, least_d, std::max(contour.hi, negligible));
  const double flattest = HWY_STATIC_DISPATCH(vir_steepness)(b, most_d, std::max(contour.lo, negligible));
  const bool rises = steepest <= 2.0 / b.w2 && d.lo > lower;
  const double lo = rises ? at(d.lo, steepest) - slack : 0.0;
  const double hi = d.hi > lower ? at(d.hi, flattest) + slack : 0.0;
  return {std::max(0.0, lo), std::max(0.0, hi)};
}

static Range vir_range(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const VirMap*>(body);
  const Range d = args[0], contour = args[1];
  const auto value = [&](double x, double c) {
    const double at[] = {x, c};
    return scalar_value(op_for<VirMap>(), body, Vec3::Zero(), at);
  };
  const double slack = vir_slack(b);
  Range r;
  if (d.lo >= 0.5)
    r.lo = std::max(0.5, value(d.lo, contour.lo) - slack);
  else
    r.lo = b.coupled ? coupled_range(b, {d.lo, std::min(d.hi, 0.5)}, contour).lo
                     : value(d.lo, contour.lo) * (1.0 - range_slack);
  if (d.hi >= 0.5)
    r.hi = std::min(1.0, value(d.hi, contour.hi) + slack);
  else
    r.hi = b.coupled ? coupled_range(b, d, contour).hi : value(d.hi, contour.hi) * (1.0 + range_slack);
  return r;
}
/// 1/w over d and f_c, and what its partials are made of: with a = 2 d/f_c - 1 and v = w'/w^2
///   d(1/w)/dd = -2 v/f_c,  d(1/w)/df_c = 2 d v/f_c^2.
struct VirSlopes {
  Range steepness, by_d, by_contour;
  VirSlopes(const VirMap& b, Range d, Range contour) {
    const double w0 = b.w_floor;
    const auto width = [&](double a) { return a <= 0.0 ? w0 : a < 2.0 * w0 ? w0 + a * a / (4.0 * w0) : a; };
    const auto slope = [&](double a) { return std::clamp(a / (2.0 * w0), 0.0, 1.0); };
    const Range a{2.0 * d.lo / contour.hi - 1.0, 2.0 * d.hi / contour.lo - 1.0};
    const Range w{width(a.lo), width(a.hi)};
    const Range v{slope(a.lo) / (w.hi * w.hi), slope(a.hi) / (w.lo * w.lo)};
    steepness = {1.0 / w.hi, 1.0 / w.lo};
    by_d = {-2.0 * v.hi / contour.lo, -2.0 * v.lo / contour.hi};
    by_contour = {2.0 * d.lo * v.lo / (contour.hi * contour.hi),
                  2.0 * d.hi * v.hi / (contour.lo * contour.lo)};
  }
};

/// The partials of T outside and inside, where it is not yet 0 or 1.
struct VirPartials {
  Range by_d, by_contour;
};
static VirPartials outside_partials(const VirMap& b, Range d, Range contour) {
  const VirSlopes s(b, d, contour);
  const Range t{d.lo - 0.5, d.hi - 0.5};
  return {s.steepness + t * s.by_d, t * s.by_contour};
}
static VirPartials inside_partials(const VirMap& b, Range d, Range contour) {
  const double c = 1.0 / b.w2;
  if (!b.coupled) return {{c, c}, {0.0, 0.0}};
  // T = 2 c q^2 (S - c) + q (2 c - S), S = 1/w.
  const VirSlopes s(b, d, contour);
  const Range q{d.lo - 0.5 * (1.0 - b.w2), d.hi - 0.5 * (1.0 - b.w2)};
  const Range by_s = (2.0 * c) * squared(q) + -1.0 * q;
  const Range by_q =
      (4.0 * c) * (q * (s.steepness + Range{-c, -c})) + (Range{2.0 * c, 2.0 * c} + -1.0 * s.steepness);
  return {by_q + by_s * s.by_d, by_s * s.by_contour};
}
static Range hull_of(Range a, Range b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }

/// By the mean-value theorem; T is continuous, its partials lie between those of its pieces.
static LinearBound vir_linear(const void* body, const LinearInput& in) {
  const auto& b = *static_cast<const VirMap*>(body);
  const Range d = in.ranges[0], contour = in.ranges[1];
  const Middle middle(in);
  if (!middle.usable || !(contour.lo > negligible) || !(d.lo >= 0.0))
    return constant_bound(Range::everything());
  const Range t = vir_range(body, in.local, in.ranges);
  VirPartials p{{1.0, 0.0}, {1.0, 0.0}};
  const auto also = [&](const VirPartials& more) {
    p = p.by_d.lo > p.by_d.hi
            ? more
            : VirPartials{hull_of(p.by_d, more.by_d), hull_of(p.by_contour, more.by_contour)};
  };
  if (d.hi >= 0.5) also(outside_partials(b, {std::max(d.lo, 0.5), d.hi}, contour));
  if (d.lo < 0.5) also(inside_partials(b, {d.lo, std::min(d.hi, 0.5)}, contour));
  if (t.lo <= 0.0 || t.hi >= 1.0) also({{0.0, 0.0}, {0.0, 0.0}});
  const Range partials[] = {spread(p.by_d, range_slack), spread(p.by_contour, range_slack)};
  const double value = scalar_value(op_for<VirMap>(), body, Vec3::Zero(), {middle.at, 2});
  return mean_value_bound(in, middle, value, partials, 2.0 * vir_slack(b));
}
static Shortcut vir_shortcut(const void* body, const Box&, std::span<const Range> args) {
  const auto& b = *static_cast<const VirMap*>(body);
  const Range d = args[0], contour = args[1];
  if (d.hi <= HWY_STATIC_DISPATCH(vir_lower_end)(b)) return Shortcut::to_constant(0.0);
  const bool one = d.lo >= 0.5 && HWY_STATIC_DISPATCH(vir_outside)(b, d.lo, contour.lo) >= 1.0 + vir_slack(b);
  return one ? Shortcut::to_constant(1.0) : Shortcut{};
}

}  // namespace detail

template <>
const Op& op_for<detail::RangeMap>() {
  using namespace detail;
  static const Op op{"range_map",
                     HWY_DYNAMIC_DISPATCH(range_map_simd)(),
                     HWY_STATIC_DISPATCH(range_map_scalar)(),
                     range_map_range,
                     range_map_shortcut,
                     range_map_linear};
  return op;
}
template <>
const Op& op_for<detail::VirMap>() {
  using namespace detail;
  static const Op op{"vir_map",
                     HWY_DYNAMIC_DISPATCH(vir_map_simd)(),
                     HWY_STATIC_DISPATCH(vir_map_scalar)(),
                     vir_range,
                     vir_shortcut,
                     vir_linear};
  return op;
}

}  // namespace blendwright
#endif
